// Functions that all readers and writers share: whole text files, numbers as text, and files that
// appear complete or not at all.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace walktrack {
inline namespace io {

// Reads the whole file. Throws an InputError that names the file and the reason, also for a folder,
// for a pipe (except /dev/stdin and the like) and for more than `max_bytes`.
std::string read_text_file(const std::filesystem::path& path, size_t max_bytes);

// The whole text as one finite number in C notation, ignoring white space around it; nullopt for
// anything else. It does not depend on the locale.
std::optional<double> number_from_text(std::string_view text);

// The shortest text that reads back as the same double.
std::string shortest_number(double value);

// The same for content that is too long for memory: it is written piece by piece and appears with
// commit(). Without commit() nothing remains. Throws a std::runtime_error that names the file and
// the reason.
class AtomicFile {
 public:
  explicit AtomicFile(const std::filesystem::path& path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void write(std::string_view content);
  void commit();

 private:
  std::filesystem::path path_, temporary_;
  int fd_ = -1;
};

// Writes a file beside `path`, flushes it to the disk and renames it: a reader sees the old file or
// the new one, never a part of it. Throws a std::runtime_error that names the file and the reason.
void write_file_atomically(const std::filesystem::path& path, std::string_view content);

// Creates an empty temporary file beside `path`: "<path>.<number>.tmp<ending>". Throws
// std::runtime_error.
std::filesystem::path new_temporary(const std::filesystem::path& path,
                                    std::string_view ending = "");

// The name for which such a temporary file (with the ending ".mp4" or none) was created; "" for any
// other name.
std::string name_of_temporary(std::string_view name);

// Creates an empty folder "<stem><six characters>" that only its owner may enter. Throws
// std::runtime_error.
std::filesystem::path new_folder(const std::filesystem::path& stem);

// Throws a UsageError if the file exists and may not be overwritten.
void refuse_existing(const std::filesystem::path& path, bool overwrite);

// Flushes a finished file and renames it to `path`; the folder is flushed as well.
void publish_file(const std::filesystem::path& temporary, const std::filesystem::path& path);

// `base / path` unless `path` is absolute; lexically normal.
std::filesystem::path resolved(const std::filesystem::path& base,
                               const std::filesystem::path& path);

}  // namespace io
}  // namespace walktrack
