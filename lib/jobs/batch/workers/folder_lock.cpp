#include "jobs/batch/workers/folder_lock.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <fstream>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "io/archive/files.h"

namespace walktrack {
inline namespace jobs {

namespace fs = std::filesystem;

namespace {

// Names that begin with .walktrack_ are reserved for the program (io/archive/result_folder.h).
constexpr const char *kProbe = ".walktrack_probe.", *kStale = ".walktrack_stale.";

// "host.boot.namespace": workers with the same place name can test whether the other's process is
// alive.
std::string place_name() {
  std::array<char, 256> host{};
  ::gethostname(host.data(), host.size() - 1);
  std::ifstream boot_file("/proc/sys/kernel/random/boot_id");
  std::string boot;
  boot_file >> boot;
  std::error_code unknown;
  const fs::path processes = fs::read_symlink("/proc/self/ns/pid", unknown);
  return fmt::format("{}.{}.{}.", host.data(), boot, processes.string());
}

// The place and the process, which identify a worker.
std::string worker_name() { return place_name() + std::to_string(::getpid()); }

// Whether the holder of the claim is a process of this place that does not exist any more.
bool holder_is_dead(const fs::path& file) {
  std::ifstream stream(file);
  std::string holder;
  std::getline(stream, holder);
  const std::string place = place_name();
  if (!holder.starts_with(place)) return false;
  const auto process = number_from_text(std::string_view(holder).substr(place.size()));
  return process && *process > 0 && ::kill(static_cast<pid_t>(*process), 0) != 0 && errno == ESRCH;
}

// Distinguishes a file from a later file of the same name.
std::pair<ino_t, int64_t> identity(const fs::path& file) {
  struct stat facts {};
  if (::stat(file.c_str(), &facts) != 0) return {};
  return {facts.st_ino, int64_t{facts.st_mtim.tv_sec} * 1'000'000'000 + facts.st_mtim.tv_nsec};
}

// Removes files of workers that were killed during a takeover.
void remove_leftovers(const fs::path& folder) {
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with(kProbe) || name.starts_with(kStale)) fs::remove(entry, ignored);
  }
}

[[noreturn]] void fail(const fs::path& file, int error) {
  throw std::runtime_error(
      fmt::format("{}: {}", file.string(), std::generic_category().message(error)));
}

// Returns false if the file exists and O_EXCL is set. Throws if nothing can be written there, so
// that this is not taken for another worker's claim.
bool write_name(const fs::path& file, int flags) {
  const int descriptor =
      ::open(file.c_str(), O_WRONLY | O_CREAT | O_NOFOLLOW | O_CLOEXEC | flags, 0666);
  if (descriptor < 0) {
    // ENOENT: the holder has just removed the folder.
    if (errno == EEXIST || errno == ENOENT) return false;
    fail(file, errno);
  }
  const std::string name = worker_name();
  const ssize_t written = ::write(descriptor, name.data(), name.size());
  const int error = written < 0 ? errno : ENOSPC;
  ::close(descriptor);
  if (written == static_cast<ssize_t>(name.size())) return true;
  ::unlink(file.c_str());
  fail(file, error);
}

// The file appears together with its holder's name or not at all, so that a worker that is killed
// here leaves no claim without a name. On file systems without links the name is written a moment
// later.
bool create_exclusively(const fs::path& file) {
  const fs::path own =
      file.parent_path() / fmt::format("{}{}.{}.new", kProbe, worker_name(), ::gettid());
  if (!write_name(own, O_TRUNC)) return false;
  struct stat facts {};
  const bool linked = ::link(own.c_str(), file.c_str()) == 0;
  const int error = linked ? 0 : errno;
  // NFS may have lost the reply of link(); the number of links shows whether it succeeded.
  const bool created = linked || (::stat(own.c_str(), &facts) == 0 && facts.st_nlink == 2);
  ::unlink(own.c_str());
  // ENOENT: the holder of the folder has removed the file as a leftover.
  if (created || error == EEXIST || error == ENOENT) return created;
  if (error != EPERM && error != EOPNOTSUPP && error != ENOSYS) fail(file, error);
  return write_name(file, O_EXCL);
}

// The age by the clock of the file system: the time of a new probe file minus that of the claim, so
// that the clocks of two machines need not agree.
double age_seconds(const fs::path& file) {
  const fs::path probe = file.parent_path() / fmt::format("{}{}", kProbe, worker_name());
  std::error_code missing;
  create_exclusively(probe);
  const auto now = fs::last_write_time(probe, missing);
  const auto then = fs::last_write_time(file, missing);
  std::error_code ignored;
  fs::remove(probe, ignored);
  return missing ? 0 : std::chrono::duration<double>(now - then).count();
}

}  // namespace

std::optional<FolderLock> FolderLock::try_take(const fs::path& folder, double stale_seconds) {
  const fs::path file = folder / kFile;
  if (!create_exclusively(file)) {
    const auto judged = identity(file);
    if (!is_dead(folder, stale_seconds)) return std::nullopt;
    // If several workers find the claim stale, rename() succeeds for one of them.
    const fs::path stale = folder / fmt::format("{}{}", kStale, worker_name());
    std::error_code lost;
    fs::rename(file, stale, lost);
    if (lost) return std::nullopt;
    const bool was_judged = identity(stale) == judged;
    // Another worker was faster, and this is its new claim, which is restored.
    if (!was_judged) fs::create_hard_link(stale, file, lost);
    fs::remove(stale, lost);
    if (!was_judged || !create_exclusively(file)) return std::nullopt;
  }
  remove_leftovers(folder);
  return FolderLock(file);
}

bool FolderLock::is_dead(const fs::path& folder, double stale_seconds) {
  return holder_is_dead(folder / kFile) || age_seconds(folder / kFile) > stale_seconds;
}

FolderLock::~FolderLock() {
  std::error_code ignored;
  if (!file_.empty() && is_held()) fs::remove(file_, ignored);
}

bool FolderLock::is_held() const {
  std::ifstream stream(file_);
  std::string holder;
  std::getline(stream, holder);
  return holder == worker_name();
}

FolderLock::FolderLock(FolderLock&& other) noexcept : file_(std::exchange(other.file_, {})) {}

void FolderLock::renew() const {
  // The file system sets the time, not this machine's clock.
  ::utimensat(AT_FDCWD, file_.c_str(), nullptr, 0);
}

}  // namespace jobs
}  // namespace walktrack
