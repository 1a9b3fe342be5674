// A list of sequences in a file, which `batch --manifest` tracks instead of those below a folder.
//
// Each line has a path relative to the manifest's folder (for standard input, to the working
// directory) and may have, after a tab, the name of its result folder below the output. Without a
// name it is made from the path, as by find_sequences(): "a/b/scene.yaml" is "a/b",
// "/data/a/one.yaml" is "data/a/one"; for paths below the manifest's folder it is relative to that.
// Empty lines and lines that begin with '#' are ignored. Whether a file exists is only checked when
// its sequence is tracked.
//
// A manifest may have millions of lines: it is read anew every time that it is iterated over, and
// eight bytes for each line are kept in memory while it is read for the first time.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace walktrack {
inline namespace jobs {

struct ManifestRow {
  std::filesystem::path file;  // absolute, lexically normal
  std::string name;            // with "/" between its parts
};

class Manifest {
 public:
  // `path`: "-" is standard input, which is copied to a temporary file, as pipes are. `videos`:
  // rows are videos, whose names lose their extension. Throws an InputError "file:line: ..." for a
  // row with more than two columns, a name that is not a path below the output, or the name of
  // another row.
  Manifest(const std::string& path, bool videos);
  ~Manifest();
  Manifest(Manifest&& other) noexcept;
  Manifest& operator=(Manifest&&) = delete;

  size_t size() const { return size_; }  // rows

  class Reader {
   public:
    explicit Reader(const Manifest& manifest) : manifest_(&manifest) {}
    // Moves to the next row; returns false at the end.
    bool advance();
    // The present row; InputError as above.
    ManifestRow row() const { return manifest_->row_of(line_, number_); }
    int line_number() const { return number_; }

   private:
    bool next_line();
    bool fill();

    const Manifest* manifest_;
    std::string block_;
    size_t at_ = 0;          // position in the block
    uint64_t offset_ = 0;    // position in the file of what follows the block
    int number_ = 0;         // line number, from 1
    std::string_view line_;  // in the block
  };

 private:
  ManifestRow row_of(std::string_view line, int number) const;
  std::string name_of(std::string_view path, int number) const;
  [[noreturn]] void fail(int number, const std::string& found, const std::string& allowed) const;
  void look_through();
  void refuse_doubles(const std::vector<uint64_t>& seen) const;

  std::string file_;              // name in messages
  std::filesystem::path folder_;  // to which paths are relative
  bool videos_;
  int fd_ = -1;
  size_t size_ = 0;
};

}  // namespace jobs
}  // namespace walktrack
