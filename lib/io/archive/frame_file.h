// The records of a track's frames on the disk, so that memory does not grow with the length of the
// video. Records are appended while frames are tracked, and read one at a time when tables and
// videos are made; the file remains if the process is killed.
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
  // Creates an empty file, or keeps the first `kept` records of the existing one. Throws an
  // InputError if it has fewer records or damaged ones, also when a record is read;
  // std::runtime_error, here and below, if it cannot be read or written.
  explicit FrameFile(const std::filesystem::path& path, size_t kept = 0);
  ~FrameFile();
  FrameFile(FrameFile&& other) noexcept;
  FrameFile& operator=(FrameFile&&) = delete;

  void append(const FrameRecord& record);
  // Returns when all records are on the disk.
  void flush() const;

  size_t size() const { return ends_.size(); }
  uint64_t bytes() const { return end_of(size()); }
  FrameRecord operator[](size_t index) const;
  // The newest record, from memory.
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
  std::vector<uint64_t> ends_;  // end of each record, bytes from the beginning of the file
  FrameRecord back_;
};

// A record from its bytes, without the length in front. Throws an InputError that names `file` if
// they are damaged.
FrameRecord frame_record_from_bytes(std::string_view bytes, std::string_view file);

// The reason why the first `bytes` bytes of the file are not `records` valid records; "" if they
// are.
std::string frame_file_trouble(const std::filesystem::path& path, uint64_t records, uint64_t bytes);

}  // namespace io
}  // namespace walktrack
