#include "io/video/lens_facts.h"

extern "C" {
#include <libavformat/avformat.h>
}

#include <fstream>

#include "core/errors.h"
#include "io/archive/files.h"
#include "io/video/video.h"

namespace walktrack {

namespace {

constexpr const char* kAppleKey = "com.apple.quicktime.camera.focal_length.35mm_equivalent";
constexpr size_t kExifBytes = 1 << 17;  // EXIF has at most 64 KiB and comes first
// TIFF's (EXIF 2.3, 4.6): the pointer to the EXIF fields, and the field itself, a 16-bit number.
constexpr unsigned kExifPointer = 0x8769, kFocalLength35mm = 0xA405;
constexpr size_t kFieldBytes = 12;

std::optional<double> lens(double focal_mm) {
  return focal_mm >= 4 && focal_mm <= 2000 ? std::optional(focal_mm) : std::nullopt;
}

// A block of numbers in either byte order; 0 beyond its end.
struct Tiff {
  std::string_view bytes;
  bool big = false;

  unsigned number(size_t at, size_t count) const {
    if (at > bytes.size() || count > bytes.size() - at) return 0;
    unsigned value = 0;
    for (size_t i = 0; i < count; ++i) {
      const size_t k = big ? i : count - 1 - i;
      value = value << 8 | static_cast<unsigned char>(bytes[at + k]);
    }
    return value;
  }
  // Where the value of a field of the directory at `at` stands; nothing without the field.
  std::optional<size_t> field(size_t at, unsigned tag) const {
    const size_t count = number(at, 2);
    for (size_t i = 0; i < count && at + 2 + (i + 1) * kFieldBytes <= bytes.size(); ++i) {
      const size_t entry = at + 2 + i * kFieldBytes;
      if (number(entry, 2) == tag) return entry + 8;
    }
    return std::nullopt;
  }
};

std::optional<double> from_tiff(std::string_view bytes) {
  if (bytes.size() < 8) return std::nullopt;
  const Tiff tiff{bytes, bytes.starts_with("MM")};
  const auto pointer = tiff.field(tiff.number(4, 4), kExifPointer);
  if (!pointer) return std::nullopt;
  const auto field = tiff.field(tiff.number(*pointer, 4), kFocalLength35mm);
  return field ? lens(tiff.number(*field, 2)) : std::nullopt;
}

std::optional<double> of_video(const std::filesystem::path& video) {
  AVFormatContext* file = nullptr;
  if (avformat_open_input(&file, video.c_str(), nullptr, nullptr) < 0) return std::nullopt;
  const AVDictionaryEntry* entry = av_dict_get(file->metadata, kAppleKey, nullptr, 0);
  for (unsigned i = 0; !entry && i < file->nb_streams; ++i)
    entry = av_dict_get(file->streams[i]->metadata, kAppleKey, nullptr, 0);
  const auto number = entry ? number_from_text(entry->value) : std::nullopt;
  avformat_close_input(&file);
  return number ? lens(*number) : std::nullopt;
}

}  // namespace

std::optional<double> exif_focal_length_35mm(std::string_view jpeg) {
  const Tiff whole{jpeg, true};
  if (whole.number(0, 2) != 0xFFD8) return std::nullopt;
  // Segments: FF, kind, length with its own two bytes. The picture begins with FFDA.
  for (size_t at = 2; whole.number(at, 1) == 0xFF && whole.number(at, 2) != 0xFFDA;) {
    const size_t length = whole.number(at + 2, 2);
    if (length < 2 || at + 2 + length > jpeg.size()) return std::nullopt;
    const std::string_view content = jpeg.substr(at + 4, length - 2);
    if (whole.number(at, 2) == 0xFFE1 && content.starts_with(std::string_view("Exif\0\0", 6)))
      return from_tiff(content.substr(6));
    at += 2 + length;
  }
  return std::nullopt;
}

std::optional<double> focal_length_35mm(const std::filesystem::path& path) {
  if (std::filesystem::is_regular_file(path))
    if (const auto found = of_video(path)) return found;
  std::vector<std::filesystem::path> images;
  try {
    images = image_files(path);
  } catch (const InputError&) {
    return std::nullopt;
  }
  if (images.empty()) return std::nullopt;  // of a video
  std::ifstream file(images.front(), std::ios::binary);
  std::string bytes(kExifBytes, '\0');
  file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  return exif_focal_length_35mm({bytes.data(), static_cast<size_t>(file.gcount())});
}

}  // namespace walktrack
