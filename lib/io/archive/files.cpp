#include "io/archive/files.h"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <random>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "core/errors.h"

namespace walktrack {
inline namespace io {

namespace fs = std::filesystem;

namespace {

std::string complaint(const fs::path& path, std::string_view what, int error) {
  return fmt::format("{}: {}: {}", path.string(), what, std::generic_category().message(error));
}

[[noreturn]] void fail_writing(const fs::path& path, std::string_view what, int error) {
  throw std::runtime_error(complaint(path, what, error));
}

// Closes a file descriptor at the end of its scope.
class Descriptor {
 public:
  Descriptor(const fs::path& path, int flags) : fd_(::open(path.c_str(), flags | O_CLOEXEC, 0666)) {
    if (fd_ < 0) fail_writing(path, "cannot be opened", errno);
  }
  ~Descriptor() { ::close(fd_); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return fd_; }

 private:
  int fd_;
};

void flush_to_disk(const fs::path& path, int flags) {
  const Descriptor file(path, flags);
  // Some file systems cannot flush a folder and report EINVAL. That is not an error.
  if (::fsync(file.get()) != 0 && errno != EINVAL) fail_writing(path, "cannot be flushed", errno);
}

}  // namespace

std::string read_text_file(const fs::path& path, size_t max_bytes) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) throw InputError(fmt::format("{}: no such file", path.string()));
  if (fs::is_directory(status)) {
    throw InputError(fmt::format("{}: found a folder, allowed: a file", path.string()));
  }
  // A read from a pipe could block for ever. Pipes are accepted in /dev only, where the shell puts
  // its own.
  if (!fs::is_regular_file(status) && !path.string().starts_with("/dev/")) {
    throw InputError(fmt::format("{}: found a pipe or a device, allowed: a file", path.string()));
  }
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw InputError(complaint(path, "cannot be opened", errno));
  std::string text;
  std::array<char, 1 << 16> block;
  while (stream.read(block.data(), block.size()) || stream.gcount() > 0) {
    text.append(block.data(), static_cast<size_t>(stream.gcount()));
    if (text.size() > max_bytes) {
      throw InputError(
          fmt::format("{}: larger than the {} MB allowed", path.string(), max_bytes >> 20));
    }
  }
  if (stream.bad()) throw InputError(complaint(path, "cannot be read", errno));
  return text;
}

std::optional<double> number_from_text(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r\n";
  const size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return std::nullopt;
  text = text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) {
    return std::nullopt;
  }
  return value;
}

std::string shortest_number(double value) { return fmt::format("{}", value); }

void publish_file(const fs::path& temporary, const fs::path& path) {
  flush_to_disk(temporary, O_RDONLY);
  if (::rename(temporary.c_str(), path.c_str()) != 0)
    fail_writing(path, "cannot be written", errno);
  const fs::path folder = path.parent_path();
  flush_to_disk(folder.empty() ? fs::path(".") : folder, O_RDONLY | O_DIRECTORY);
}

// Other writers, in other threads or on other machines that share the folder, choose other random
// numbers. If two numbers are equal, O_EXCL makes one of the writers fail, and it refuses links.
fs::path new_temporary(const fs::path& path, std::string_view ending) {
  std::random_device random;  // names only: no result depends on it
  fs::path name;
  do {
    name = path.string() + fmt::format(".{}{:010}.tmp{}", ::getpid(), random(), ending);
  } while (fs::exists(name));
  Descriptor(name, O_WRONLY | O_CREAT | O_EXCL);
  return name;
}

std::string name_of_temporary(std::string_view name) {
  for (const std::string_view end : {".tmp", ".tmp.mp4"}) {
    if (!name.ends_with(end)) continue;
    const std::string_view rest = name.substr(0, name.size() - end.size());
    const size_t dot = rest.find_last_not_of("0123456789");
    const bool made = dot != std::string_view::npos && rest[dot] == '.' && dot + 1 < rest.size();
    return made ? std::string(rest.substr(0, dot)) : "";
  }
  return "";
}

fs::path new_folder(const fs::path& stem) {
  std::string name = stem.string() + "XXXXXX";
  if (!::mkdtemp(name.data())) fail_writing(name, "cannot be made", errno);
  return name;
}

void refuse_existing(const fs::path& path, bool overwrite) {
  if (!overwrite && fs::exists(path)) {
    throw UsageError(fmt::format("{} exists; -y overwrites it", path.string()));
  }
}

AtomicFile::AtomicFile(const fs::path& path) : path_(path), temporary_(new_temporary(path)) {
  fd_ = ::open(temporary_.c_str(), O_WRONLY | O_NOFOLLOW | O_CLOEXEC);
  if (fd_ < 0) fail_writing(temporary_, "cannot be opened", errno);
}

AtomicFile::~AtomicFile() {
  if (fd_ < 0) return;
  ::close(fd_);
  ::unlink(temporary_.c_str());
}

void AtomicFile::write(std::string_view content) {
  while (!content.empty()) {
    const ssize_t written = ::write(fd_, content.data(), content.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail_writing(path_, "cannot be written", errno);
    content.remove_prefix(static_cast<size_t>(written));
  }
}

void AtomicFile::commit() {
  ::close(std::exchange(fd_, -1));
  publish_file(temporary_, path_);
}

void write_file_atomically(const fs::path& path, std::string_view content) {
  AtomicFile file(path);
  file.write(content);
  file.commit();
}

fs::path resolved(const fs::path& base, const fs::path& path) {
  return (path.is_absolute() ? path : base / path).lexically_normal();
}

}  // namespace io
}  // namespace walktrack
