#include "jobs/batch/bids/bids_report.h"

#include <map>
#include <set>

#include "io/archive/files.h"
#include "jobs/batch/bids/bids_names.h"
#include "jobs/batch/bids/bids_tables.h"
#include "jobs/batch/workers/batch_work.h"

namespace walktrack {
inline namespace jobs {

namespace fs = std::filesystem;

namespace {

constexpr const char* kIgnored =
    "results/\nsummary.csv\nfailures.txt\nbatch.html\n.walktrack_*\n**/.walktrack_*\n";

struct TrackedVideo {
  BidsName name;
  Sequence sequence;
};

// Complete results by the folder of their tables; of the others only the folder is listed.
std::map<fs::path, std::vector<TrackedVideo>> by_folder(const SequenceList& list) {
  std::map<fs::path, std::vector<TrackedVideo>> out;
  auto all = list.sequences(SequenceList::Share::kAll);
  while (const auto sequence = all.next()) {
    const auto name = bids_name(fs::path(sequence->video).stem().string());
    if (!name) continue;
    std::vector<TrackedVideo>& videos = out[motion_folder(*name)];
    if (is_complete_result(sequence->output)) videos.push_back({*name, *sequence});
  }
  return out;
}

std::string file_of(const BidsName& name, const std::string& table) {
  return tracked_entities_text(name) + "_" + table;
}

// A BIDS URI, in which the data set from which the output is derived is called "raw".
std::string source_of(const BatchJob& job, const Sequence& sequence) {
  const fs::path way = fs::weakly_canonical(sequence.video.parent_path())
                           .lexically_relative(fs::weakly_canonical(job.folder));
  return "bids:raw:" + (way / sequence.video.filename()).generic_string();
}

void write_tables(const BatchJob& job, const fs::path& place,
                  const std::vector<TrackedVideo>& videos) {
  refuse_links(job.output, place);
  Outputs outputs{job.output / place, "batch", {}, {}, ""};
  if (videos.empty() && !fs::exists(outputs.folder)) return;
  for (const TrackedVideo& video : videos)
    for (const std::string& table : bids_file_names())
      outputs.files.push_back(file_of(video.name, table));
  const std::vector<std::string_view> kept(outputs.files.begin(), outputs.files.end());
  const ResultFolder folder(outputs, true, kept);
  for (const TrackedVideo& video : videos) {
    const BidsOrigin origin{video.name.label("task").value_or(""), source_of(job, video.sequence),
                            kTrackingSystem};
    for (const BidsFile& file : bids_files(video.sequence.output, origin))
      folder.write(file_of(video.name, file.name), file.content);
  }
}

}  // namespace

void write_bids(const BatchJob& job, const SequenceList& list, const ResultFolder& folder) {
  for (const auto& [place, videos] : by_folder(list)) write_tables(job, place, videos);
  folder.write(kBidsDescription, bids_description(job.folder, job.output));
  const fs::path ignored = job.output / ".bidsignore";
  if (!fs::exists(fs::symlink_status(ignored))) write_file_atomically(ignored, kIgnored);
}

}  // namespace jobs
}  // namespace walktrack
