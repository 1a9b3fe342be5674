// A worker's claim on a sequence: a FolderLock in a hidden folder beside the result folder. That
// folder also contains files that have to be on the result's file system before the result appears.
#pragma once

#include <filesystem>
#include <optional>

#include "jobs/batch/workers/folder_lock.h"

namespace walktrack {
inline namespace jobs {

// The hidden folder of a result folder: ".walktrack_for.<its name>".
std::filesystem::path hidden_folder(const std::filesystem::path& result);

class SequenceClaim {
 public:
  // nullopt if another worker holds it. Creates the folders above the result.
  static std::optional<SequenceClaim> try_take(const std::filesystem::path& result);
  // Releases the claim and removes the hidden folder.
  ~SequenceClaim();
  SequenceClaim(SequenceClaim&& other) noexcept = default;
  SequenceClaim& operator=(SequenceClaim&&) = delete;

  const std::filesystem::path& folder() const { return folder_; }
  void renew() const { lock_->renew(); }
  // Whether it was not taken over.
  bool is_held() const { return lock_->is_held(); }

 private:
  SequenceClaim(std::filesystem::path folder, FolderLock lock)
      : folder_(std::move(folder)), lock_(std::move(lock)) {}
  std::filesystem::path folder_;
  std::optional<FolderLock> lock_;
};

// Whether a worker that seems to be alive holds a claim on it.
bool is_claimed(const std::filesystem::path& result);

// Removes the claim of a worker that was killed.
void clear_dead_claim(const std::filesystem::path& result);

}  // namespace jobs
}  // namespace walktrack
