// The records of a track's frames, kept on the disk: a video may be long, memory does not grow with
// it. Records are appended as frames are tracked and read back, one at a time, when tables and
// videos are made of them; the file outlives a process that is killed.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "tracker/walker_filter.h"

namespace walktrack {
inline namespace io {

class FrameFile {
 public:
  // An empty file, or the first `kept` records of the one that is there. InputError if it holds
  // fewer or damaged ones, and where one is read back; std::runtime_error, here and below, if it
  // cannot be read or written.
  explicit FrameFile(const std::filesystem::path& path, size_t kept = 0);
  ~FrameFile();
  FrameFile(FrameFile&& other) noexcept;
  FrameFile& operator=(FrameFile&&) = delete;

  void append(const FrameRecord& record);
  // All records reach the disk.
  void flush() const;

  size_t size() const { return ends_.size(); }
  uint64_t bytes() const { return end_of(size()); }
  FrameRecord operator[](size_t index) const;
  // The newest one, without a look at the disk.
  const FrameRecord& back() const { return back_; }

  class Iterator {
   public:
    Iterator(const FrameFile& file, size_t index) : file_(file), index_(index) {}
    FrameRecord operator*() const { return file_[index_]; }
    Iterator& operator++() {
      ++index_;
      return *this;
    }
    bool operator!=(const Iterator& other) const { return index_ != other.index_; }

   private:
    const FrameFile& file_;
    size_t index_;
  };
  Iterator begin() const { return {*this, 0}; }
  Iterator end() const { return {*this, size()}; }

 private:
  struct Opened {
    std::filesystem::path path;
    int fd;
  };
  explicit FrameFile(Opened file);
  uint64_t end_of(size_t records) const { return records > 0 ? ends_[records - 1] : 0; }
  std::string read(uint64_t from, size_t size) const;

  std::filesystem::path path_;
  int fd_ = -1;
  std::vector<uint64_t> ends_;  // of each record, bytes from the beginning
  FrameRecord back_;
};

// A record of its bytes, without the length in front. InputError, naming `file`, for damaged ones.
FrameRecord frame_record_from_bytes(std::string_view bytes, std::string_view file);

// Why the file does not hold `records` sound records in its first `bytes` bytes; "": it does.
std::string frame_file_trouble(const std::filesystem::path& path, uint64_t records, uint64_t bytes);

}  // namespace io
}  // namespace walktrack
