// A claim on a folder, so that several workers, also of several machines that share it, never do
// the same work twice. The claim is a file whose creation succeeds for one worker alone; while it
// works it renews the file's time. A claim whose worker was a process of this machine that is no
// more, or that nobody has renewed for kStaleSeconds, belongs to a dead worker and is taken over.
#pragma once

#include <filesystem>
#include <optional>

namespace walktrack {

inline constexpr double kStaleSeconds = 60;

class Claim {
 public:
  static constexpr const char* kFile = ".walktrack_claim";  // its name in the folder

  // nullopt if another worker holds the folder.
  static std::optional<Claim> try_take(const std::filesystem::path& folder,
                                       double stale_seconds = kStaleSeconds);
  // Gives it back.
  ~Claim();
  Claim(Claim&& other) noexcept;
  Claim& operator=(Claim&&) = delete;

  // To be called more often than every kStaleSeconds.
  void renew() const;

 private:
  explicit Claim(std::filesystem::path file) : file_(std::move(file)) {}
  std::filesystem::path file_;  // empty = given away
};

}  // namespace walktrack
