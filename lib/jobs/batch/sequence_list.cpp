#include "jobs/batch/sequence_list.h"

#include "core/errors.h"
#include "jobs/batch/bids/bids_names.h"

namespace walktrack {
inline namespace jobs {

namespace {

std::vector<Sequence> found_for(const BatchJob& job) {
  if (!job.manifest.empty()) return {};
  if (job.bids) return find_bids_videos(job.folder, job.output);
  return job.scene_template.empty() ? find_sequences(job.folder, job.output)
                                    : find_videos(job.folder, job.output);
}

std::string wanted_by(const BatchJob& job) {
  if (!job.manifest.empty()) return "paths of scenes, one a line";
  if (job.bids) return "videos named sub-<label>/.../sub-<label>_task-<label>_video.mp4";
  return job.scene_template.empty() ? "scene*.yaml files, or .yaml files that list cameras"
                                    : "video files";
}

}  // namespace

SequenceList::SequenceList(const BatchJob& job)
    : output_(job.output),
      videos_(!job.scene_template.empty()),
      shard_(static_cast<size_t>(job.shard - 1)),
      shards_(static_cast<size_t>(job.shards)),
      found_(found_for(job)) {
  if (!job.manifest.empty()) manifest_.emplace(job.manifest, videos_);
  if (size() > 0) return;
  const std::string place = job.manifest.empty() ? job.folder.string() : job.manifest;
  throw UsageError(describe({place, 0, ""}, "no sequence", wanted_by(job)));
}

Sequence SequenceList::sequence_of(ManifestRow row) const {
  std::filesystem::path output = output_ / row.name;
  if (!videos_) return {std::move(row.name), std::move(row.file), std::move(output)};
  return {std::move(row.name), output / "scene.yaml", output, std::move(row.file)};
}

bool SequenceList::takes(Share share, size_t index) const {
  return share == Share::kAll || (index % shards_ == shard_) == (share == Share::kOwn);
}

std::optional<Sequence> SequenceList::Cursor::next() {
  while (reader_ ? reader_->advance() : index_ < list_->found_.size()) {
    const size_t index = index_++;
    if (!list_->takes(share_, index)) continue;
    return reader_ ? list_->sequence_of(reader_->row()) : list_->found_[index];
  }
  return std::nullopt;
}

}  // namespace jobs
}  // namespace walktrack
