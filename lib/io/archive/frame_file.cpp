#include "io/archive/frame_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "core/errors.h"
#include "io/archive/state_checks.h"
#include "io/archive/state_fields.h"

namespace walktrack {
inline namespace io {

namespace {

// The length in front of each record.
constexpr size_t kLengthBytes = sizeof(uint32_t);

[[noreturn]] void fail(const std::filesystem::path& path, std::string_view what) {
  throw std::runtime_error(
      fmt::format("{}: {}: {}", path.string(), what, std::generic_category().message(errno)));
}

uint32_t length_from(const std::string& bytes) {
  uint32_t length = 0;
  std::memcpy(&length, bytes.data(), kLengthBytes);
  return length;
}

}  // namespace

FrameFile::FrameFile(Opened file) : path_(std::move(file.path)), fd_(file.fd) {
  if (fd_ < 0) fail(path_, "cannot be opened");
}

// Delegates to the other constructor, so that the destructor closes the file if this one throws
// because a record is damaged.
FrameFile::FrameFile(const std::filesystem::path& path, size_t kept)
    : FrameFile(
          Opened{path, ::open(path.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0666)}) {
  for (size_t i = 0; i < kept; ++i) {
    const uint64_t from = end_of(i);
    ends_.push_back(from + kLengthBytes + length_from(read(from, kLengthBytes)));
  }
  if (kept > 0) back_ = (*this)[kept - 1];
  if (::ftruncate(fd_, static_cast<off_t>(end_of(kept))) != 0) fail(path_, "cannot be cut");
}

FrameFile::~FrameFile() {
  if (fd_ >= 0) ::close(fd_);
}

FrameFile::FrameFile(FrameFile&& other) noexcept
    : path_(std::move(other.path_)),
      fd_(std::exchange(other.fd_, -1)),
      ends_(std::move(other.ends_)),
      back_(std::move(other.back_)) {}

void FrameFile::append(const FrameRecord& record) {
  ArchiveWriter archive;
  archive(uint32_t{0}, record);
  std::string bytes = archive.bytes();
  const auto length = static_cast<uint32_t>(bytes.size() - kLengthBytes);
  std::memcpy(bytes.data(), &length, kLengthBytes);
  uint64_t at = end_of(size());
  for (std::string_view rest = bytes; !rest.empty();) {
    const ssize_t written = ::pwrite(fd_, rest.data(), rest.size(), static_cast<off_t>(at));
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail(path_, "cannot be written");
    at += static_cast<uint64_t>(written);
    rest.remove_prefix(static_cast<size_t>(written));
  }
  ends_.push_back(at);
  back_ = record;
}

void FrameFile::flush() const {
  if (::fsync(fd_) != 0 && errno != EINVAL) fail(path_, "cannot be flushed");
}

std::string FrameFile::read(uint64_t from, size_t size) const {
  const auto lost = [&] {
    return InputError(fmt::format("{}: has lost its last frames", path_.string()));
  };
  struct stat about = {};
  if (::fstat(fd_, &about) != 0) fail(path_, "cannot be read");
  if (from + size > static_cast<uint64_t>(about.st_size)) throw lost();
  std::string bytes(size, '\0');
  for (size_t done = 0; done < size;) {
    const ssize_t got =
        ::pread(fd_, bytes.data() + done, size - done, static_cast<off_t>(from + done));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail(path_, "cannot be read");
    if (got == 0) throw lost();
    done += static_cast<size_t>(got);
  }
  return bytes;
}

FrameRecord FrameFile::operator[](size_t index) const {
  const uint64_t from = end_of(index) + kLengthBytes;
  return frame_record_from_bytes(read(from, static_cast<size_t>(ends_.at(index) - from)),
                                 path_.native());
}

FrameRecord frame_record_from_bytes(std::string_view bytes, std::string_view file) {
  ArchiveReader archive(bytes, file);
  FrameRecord record;
  archive(record);
  if (!archive.at_end()) archive.fail("more than it announces");
  if (const std::string_view trouble = trouble_of(record); !trouble.empty()) archive.fail(trouble);
  return record;
}

std::string frame_file_trouble(const std::filesystem::path& path, uint64_t records,
                               uint64_t bytes) try {
  std::string lacking =
      fmt::format("{}: lacks frames that the checkpoint counts on", path.string());
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored) || std::filesystem::file_size(path) < bytes)
    return lacking;
  std::ifstream stream(path, std::ios::binary);
  uint64_t left = bytes;
  std::string text;
  const auto take = [&](uint64_t size) {
    if (size > left) return false;
    left -= size;
    text.resize(static_cast<size_t>(size));
    return bool(stream.read(text.data(), static_cast<std::streamsize>(size)));
  };
  for (uint64_t i = 0; i < records; ++i) {
    if (!take(kLengthBytes) || !take(length_from(text))) return lacking;
    frame_record_from_bytes(text, path.native());
  }
  return left == 0 ? "" : fmt::format("{}: holds other frames than the checkpoint", path.string());
} catch (const InputError& error) {
  return error.what();
}

}  // namespace io
}  // namespace walktrack
