#include "jobs/batch/workers/sequence_claim.h"

#include <string>

#include "core/errors.h"
#include "io/archive/result_folder.h"
#include "io/archive/sha256.h"

namespace walktrack {
inline namespace jobs {

namespace fs = std::filesystem;

fs::path hidden_folder(const fs::path& result) {
  constexpr size_t kLongestName = 200;  // bytes; file systems take 255
  std::string name = result.filename().string();
  if (name.size() > kLongestName) name = sha256(name);
  return result.parent_path() / (kHiddenFolder + name);
}

namespace {

// A worker that releases a claim removes the folder, possibly while another one is creating a lock
// in it.
std::optional<FolderLock> lock_of_hidden(const fs::path& folder) {
  constexpr int kTries = 3;
  for (int i = 0; i < kTries; ++i) {
    if (fs::is_symlink(folder))
      throw UsageError(describe({folder.string(), 0, ""}, "a link", "a folder of the batch's own"));
    fs::create_directories(folder);
    std::optional<FolderLock> lock = FolderLock::try_take(folder);
    if (lock || fs::exists(folder / FolderLock::kFile)) return lock;
  }
  return std::nullopt;
}

}  // namespace

std::optional<SequenceClaim> SequenceClaim::try_take(const fs::path& result) {
  const fs::path folder = hidden_folder(result);
  std::optional<FolderLock> lock = lock_of_hidden(folder);
  if (!lock) return std::nullopt;
  // Removes unfinished files of a worker that was killed.
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().filename() != FolderLock::kFile) fs::remove_all(entry.path());
  return SequenceClaim(folder, std::move(*lock));
}

SequenceClaim::~SequenceClaim() {
  if (!lock_ || lock_->given_away()) return;
  std::error_code ignored;
  const bool ours = is_held();
  for (const auto& entry : fs::directory_iterator(folder_, ignored))
    if (ours && entry.path().filename() != FolderLock::kFile) fs::remove_all(entry.path(), ignored);
  lock_.reset();
  fs::remove(folder_, ignored);  // has no effect if another worker has put a lock into it
}

bool is_claimed(const fs::path& result) {
  const fs::path folder = hidden_folder(result);
  std::error_code none;
  return fs::exists(folder / FolderLock::kFile, none) && !FolderLock::is_dead(folder);
}

void clear_dead_claim(const fs::path& result) {
  std::error_code none;
  if (fs::exists(hidden_folder(result), none)) SequenceClaim::try_take(result);
}

}  // namespace jobs
}  // namespace walktrack
