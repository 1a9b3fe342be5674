// Small things that all readers and writers share: whole text files, numbers as text, and files
// that appear complete or not at all.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace walktrack {
inline namespace io {

// The whole file. InputError naming the file and the reason, also when it is a folder, a pipe (but
// /dev/stdin and its like) or larger than `max_bytes`.
std::string read_text_file(const std::filesystem::path& path, size_t max_bytes);

// The whole text as one finite number in C notation, blanks around it ignored; nullopt if it is
// anything else. It does not depend on the locale.
std::optional<double> number_from_text(std::string_view text);

// The shortest text that reads back as the same double.
std::string shortest_number(double value);

// The same for what is too long to be held at once: written piece by piece, there after commit().
// Without it, nothing is left. std::runtime_error naming the file and the reason.
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

// Writes next to `path`, flushes to the disk and renames: a reader sees the old file or the new
// one, never half of it. std::runtime_error naming the file and the reason.
void write_file_atomically(const std::filesystem::path& path, std::string_view content);

// A new, empty file beside `path` and for it: "<path>.<number>.tmp<ending>". std::runtime_error.
std::filesystem::path new_temporary(const std::filesystem::path& path,
                                    std::string_view ending = "");

// The name that such a file, ending ".mp4" or none, is made for; "" for any other name.
std::string name_of_temporary(std::string_view name);

// A new, empty folder "<stem><six characters>" that nobody else may enter. std::runtime_error.
std::filesystem::path new_folder(const std::filesystem::path& stem);

// UsageError when the file exists and may not be overwritten.
void refuse_existing(const std::filesystem::path& path, bool overwrite);

// Flushes a finished file, then renames it over `path`; the folder is flushed too.
void publish_file(const std::filesystem::path& temporary, const std::filesystem::path& path);

// `base / path`, unless path is absolute; lexically normal.
std::filesystem::path resolved(const std::filesystem::path& base,
                               const std::filesystem::path& path);

}  // namespace io
}  // namespace walktrack
