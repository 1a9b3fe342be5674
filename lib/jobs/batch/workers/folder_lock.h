// A claim on a folder, so that several workers, also on several machines that share it, never do
// the same work twice. The claim is a file whose creation succeeds for only one worker, which
// renews the file's time while it works. A claim may be taken over if its worker was a process of
// this machine that no longer exists, or if it was not renewed for kStaleSeconds.
#pragma once

#include <filesystem>
#include <optional>

namespace walktrack {
inline namespace jobs {

// The age at which a lock counts as abandoned; by hand.
inline constexpr double kStaleSeconds = 60;

class FolderLock {
 public:
  static constexpr const char* kFile = ".walktrack_claim";  // its name in the folder

  // nullopt if another worker holds the folder.
  static std::optional<FolderLock> try_take(const std::filesystem::path& folder,
                                            double stale_seconds = kStaleSeconds);
  // Releases the claim.
  ~FolderLock();
  FolderLock(FolderLock&& other) noexcept;
  FolderLock& operator=(FolderLock&&) = delete;

  // Must be called more often than every kStaleSeconds.
  void renew() const;
  // Whether the claim still belongs to this worker, and was not taken over.
  bool is_held() const;
  bool given_away() const { return file_.empty(); }

  // Whether the claim on the folder belongs to a dead worker.
  static bool is_dead(const std::filesystem::path& folder, double stale_seconds = kStaleSeconds);

 private:
  explicit FolderLock(std::filesystem::path file) : file_(std::move(file)) {}
  std::filesystem::path file_;  // empty = released
};

}  // namespace jobs
}  // namespace walktrack
