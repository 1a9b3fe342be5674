// The sequences of a batch in their order: those found below a folder, which are kept in memory, or
// the rows of a manifest, which are read from the file.
#pragma once

#include <optional>
#include <vector>

#include "jobs/batch/batch_job.h"
#include "jobs/batch/batch_sequences.h"
#include "jobs/batch/manifest.h"

namespace walktrack {
inline namespace jobs {

class SequenceList {
 public:
  // Finds the sequences of the job. InputError for a folder or a manifest that cannot be read,
  // UsageError if there is no sequence.
  explicit SequenceList(const BatchJob& job);

  size_t size() const { return manifest_ ? manifest_->size() : found_.size(); }

  enum class Share { kAll, kOwn, kOthers };  // of the job's shard

  class Cursor {
   public:
    std::optional<Sequence> next();

   private:
    friend class SequenceList;
    Cursor(const SequenceList& list, Share share) : list_(&list), share_(share) {
      if (list.manifest_) reader_.emplace(*list.manifest_);
    }
    const SequenceList* list_;
    Share share_;
    size_t index_ = 0;
    std::optional<Manifest::Reader> reader_;
  };
  Cursor sequences(Share share) const { return {*this, share}; }

 private:
  Sequence sequence_of(ManifestRow row) const;
  bool takes(Share share, size_t index) const;

  std::filesystem::path output_;
  bool videos_;
  size_t shard_, shards_;
  std::vector<Sequence> found_;
  std::optional<Manifest> manifest_;
};

}  // namespace jobs
}  // namespace walktrack
