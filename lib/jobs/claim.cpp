#include "jobs/claim.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <fmt/format.h>

namespace walktrack {

namespace fs = std::filesystem;

namespace {

constexpr const char* kName = "claim";

// "host.pid", which tells workers apart.
std::string worker_name() {
  std::array<char, 256> host{};
  ::gethostname(host.data(), host.size() - 1);
  return fmt::format("{}.{}", host.data(), ::getpid());
}

bool create_exclusively(const fs::path& file) {
  const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (descriptor < 0) {
    if (errno == EEXIST) return false;
    throw std::runtime_error(
        fmt::format("{}: {}", file.string(), std::generic_category().message(errno)));
  }
  const std::string name = worker_name();
  const bool written = ::write(descriptor, name.data(), name.size()) >= 0;
  ::close(descriptor);
  return written;
}

// Age by the clock of the file system's last writer here: a probe file's time minus the claim's, so
// that the clocks of two machines need not agree.
double age_seconds(const fs::path& file) {
  const fs::path probe = file.parent_path() / fmt::format("probe.{}", worker_name());
  std::error_code missing;
  create_exclusively(probe);
  const auto now = fs::last_write_time(probe, missing);
  const auto then = fs::last_write_time(file, missing);
  std::error_code ignored;
  fs::remove(probe, ignored);
  return missing ? 0 : std::chrono::duration<double>(now - then).count();
}

}  // namespace

std::optional<Claim> Claim::try_take(const fs::path& folder, double stale_seconds) {
  const fs::path file = folder / kName;
  if (create_exclusively(file)) return Claim(file);
  if (age_seconds(file) <= stale_seconds) return std::nullopt;
  // Of several workers that find it stale, the rename succeeds for one.
  const fs::path stale = folder / fmt::format("stale.{}", worker_name());
  std::error_code lost;
  fs::rename(file, stale, lost);
  if (lost) return std::nullopt;
  fs::remove(stale);
  if (!create_exclusively(file)) return std::nullopt;
  return Claim(file);
}

Claim::~Claim() {
  std::error_code ignored;
  if (!file_.empty()) fs::remove(file_, ignored);
}

Claim::Claim(Claim&& other) noexcept : file_(std::exchange(other.file_, {})) {}

void Claim::renew() const {
  // The time is set by the file system, not by this machine's clock.
  ::utimensat(AT_FDCWD, file_.c_str(), nullptr, 0);
}

}  // namespace walktrack
