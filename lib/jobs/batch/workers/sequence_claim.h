// A worker's claim on a sequence: a FolderLock in a hidden folder beside the result folder. Files
// that have to be on the result's file system before the result appears are in that hidden folder,
// too, so that the result folder holds only the result.
#pragma once

#include <filesystem>
#include <optional>

#include "jobs/batch/workers/folder_lock.h"

namespace walktrack {
inline namespace jobs {

// Beside a result folder and for it: ".walktrack_for.<its name>".
std::filesystem::path hidden_folder(const std::filesystem::path& result);

class SequenceClaim {
 public:
  // nullopt if another worker holds it. Makes the folders above the result.
  static std::optional<SequenceClaim> try_take(const std::filesystem::path& result);
  // Gives it back, and removes the hidden folder.
  ~SequenceClaim();
  SequenceClaim(SequenceClaim&& other) noexcept = default;
  SequenceClaim& operator=(SequenceClaim&&) = delete;

  const std::filesystem::path& folder() const { return folder_; }
  void renew() const { lock_->renew(); }
  // Whether nobody has taken it over for a dead worker's.
  bool is_held() const { return lock_->is_held(); }

 private:
  SequenceClaim(std::filesystem::path folder, FolderLock lock)
      : folder_(std::move(folder)), lock_(std::move(lock)) {}
  std::filesystem::path folder_;
  std::optional<FolderLock> lock_;
};

// Whether a worker holds it: one that lives, as far as can be seen.
bool is_claimed(const std::filesystem::path& result);

// Gives back what a worker that was killed has left, if there is such a claim.
void clear_dead_claim(const std::filesystem::path& result);

}  // namespace jobs
}  // namespace walktrack
