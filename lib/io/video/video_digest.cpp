#include "io/video/video_digest.h"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <numeric>

#include <fmt/format.h>

#include "core/errors.h"
#include "io/archive/sha256.h"
#include "io/scene/scene.h"
#include "io/video/image_files.h"

namespace walktrack {
inline namespace io {

namespace fs = std::filesystem;

namespace {

constexpr uint64_t kBlock = uint64_t{1} << 16;  // bytes
constexpr uint64_t kBlocks = 64;

struct FilePart {
  fs::path file;
  uint64_t begin, size;  // offset in the video and length, bytes
};

std::vector<FilePart> parts_of(const fs::path& video) {
  const bool many = is_frame_pattern(video) || fs::is_directory(video);
  std::vector<FilePart> parts;
  uint64_t begin = 0;
  for (const fs::path& file : many ? image_files(video) : std::vector{video}) {
    std::error_code error;
    const uint64_t size = fs::file_size(file, error);
    if (error) throw InputError(fmt::format("{}: {}", file.string(), error.message()));
    parts.push_back({file, begin, size});
    begin += size;
  }
  return parts;
}

std::string bytes_at(const FilePart& part, uint64_t from, uint64_t count) {
  std::ifstream stream(part.file, std::ios::binary);
  stream.seekg(static_cast<std::streamoff>(from));
  std::string bytes(static_cast<size_t>(count), '\0');
  if (!stream.read(bytes.data(), static_cast<std::streamsize>(count)))
    throw InputError(fmt::format("{}: cannot be read", part.file.string()));
  return bytes;
}

// `count` bytes of the video from `from` on, across its files.
std::string video_bytes(const std::vector<FilePart>& parts, uint64_t from, uint64_t count) {
  std::string bytes;
  auto part = std::upper_bound(parts.begin(), parts.end(), from,
                               [](uint64_t at, const FilePart& each) { return at < each.begin; });
  for (--part; part != parts.end() && count > 0; ++part) {
    const uint64_t skipped = from - part->begin, here = std::min(count, part->size - skipped);
    bytes += bytes_at(*part, skipped, here);
    from += here;
    count -= here;
  }
  return bytes;
}

}  // namespace

std::string video_digest(const fs::path& video) {
  const std::vector<FilePart> parts = parts_of(video);
  std::string text;
  for (const FilePart& part : parts)
    text +=
        fmt::format("{} {}\n", parts.size() > 1 ? part.file.filename().string() : "", part.size);
  const uint64_t size = parts.back().begin + parts.back().size;
  const uint64_t count = std::min(kBlocks, (size + kBlock - 1) / kBlock);
  for (uint64_t i = 0; i < count; ++i) {
    const bool whole = size <= kBlock * kBlocks;
    const uint64_t from = whole ? i * kBlock : (size - kBlock) / (kBlocks - 1) * i;
    const uint64_t last = !whole && i == kBlocks - 1 ? size - kBlock : from;
    text += sha256(video_bytes(parts, last, std::min(kBlock, size - last)));
  }
  return sha256(text);
}

}  // namespace io
}  // namespace walktrack
