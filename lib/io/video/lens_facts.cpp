#include "io/video/lens_facts.h"

#include <algorithm>
#include <array>
#include <fstream>

#include "core/errors.h"
#include "io/archive/files.h"
#include "io/ffmpeg/ffmpeg.h"
#include "io/video/image_files.h"

namespace walktrack {
inline namespace io {

namespace {

constexpr const char* kAppleKey = "com.apple.quicktime.camera.focal_length.35mm_equivalent";
constexpr std::array<const char*, 3> kModelKeys{"com.apple.quicktime.model", "com.android.model",
                                                "model"};
constexpr size_t kExifBytes = 1 << 17;  // EXIF has at most 64 KiB and comes first
// TIFF's (EXIF 2.3, 4.6): the name of the camera, the pointer to the EXIF fields, and the focal
// length among those, a 16-bit number.
constexpr unsigned kModel = 0x0110, kExifPointer = 0x8769, kFocalLength35mm = 0xA405;
constexpr size_t kFieldBytes = 12, kInPlaceBytes = 4;

// Focal lengths of main cameras by the beginning of the telephone's name, longer names first; mm in
// equivalents of 35 mm film, from the makers' data sheets.
struct Telephone {
  std::string_view name;
  double focal_mm;
};
constexpr std::array kTelephones{
    Telephone{"iPhone 16 Pro", 24}, Telephone{"iPhone 16", 26},     Telephone{"iPhone 15 Pro", 24},
    Telephone{"iPhone 15", 26},     Telephone{"iPhone 14 Pro", 24}, Telephone{"iPhone 14", 26},
    Telephone{"iPhone 13", 26},     Telephone{"iPhone 12", 26},     Telephone{"iPhone 11", 26},
    Telephone{"iPhone XR", 26},     Telephone{"iPhone XS", 26},     Telephone{"iPhone X", 28},
    Telephone{"iPhone SE (", 28},   Telephone{"iPhone SE", 29},     Telephone{"iPhone 8", 28},
    Telephone{"iPhone 7", 28},      Telephone{"iPhone 6", 29},      Telephone{"Pixel 8", 25},
    Telephone{"Pixel 7", 25},       Telephone{"Pixel 6a", 27},      Telephone{"Pixel 6", 25},
    Telephone{"Pixel 5", 27},       Telephone{"Pixel 4", 27},       Telephone{"SM-S921", 24},
    Telephone{"SM-S911", 24},       Telephone{"SM-S901", 23},       Telephone{"SM-G991", 26},
    Telephone{"SM-G98", 26},        Telephone{"SM-G973", 26}};

std::optional<double> lens(double focal_mm) {
  return focal_mm >= 4 && focal_mm <= 2000 ? std::optional(focal_mm) : std::nullopt;
}

// A block of numbers in either byte order; reads 0 beyond its end.
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
  // The offset of the value of a field in the directory at `at`; nullopt if there is no such field.
  std::optional<size_t> field(size_t at, unsigned tag) const {
    const size_t count = number(at, 2);
    for (size_t i = 0; i < count && at + 2 + (i + 1) * kFieldBytes <= bytes.size(); ++i) {
      const size_t entry = at + 2 + i * kFieldBytes;
      if (number(entry, 2) == tag) return entry + 8;
    }
    return std::nullopt;
  }
};

std::optional<double> focal_length(const Tiff& tiff) {
  const auto pointer = tiff.field(tiff.number(4, 4), kExifPointer);
  if (!pointer) return std::nullopt;
  const auto field = tiff.field(tiff.number(*pointer, 4), kFocalLength35mm);
  return field ? lens(tiff.number(*field, 2)) : std::nullopt;
}

// The text of a name, without its terminator.
std::string name_of(std::string_view text) {
  const auto end = text.find_first_of(std::string_view("\0\n", 2));
  text = text.substr(0, std::min(end, text.size()));
  while (text.ends_with(' ')) text.remove_suffix(1);
  return std::string(text);
}

std::string model(const Tiff& tiff) {
  const auto field = tiff.field(tiff.number(4, 4), kModel);
  if (!field) return {};
  const size_t bytes = tiff.number(*field - 4, 4);
  const size_t at = bytes > kInPlaceBytes ? tiff.number(*field, 4) : *field;
  return at < tiff.bytes.size() ? name_of(tiff.bytes.substr(at, bytes)) : std::string();
}

// The EXIF block of a JPEG; empty if there is none.
Tiff exif_of(std::string_view jpeg) {
  const Tiff whole{jpeg, true};
  if (whole.number(0, 2) != 0xFFD8) return {};
  // Segments are FF, kind and a length that includes its own two bytes. The image data begin with
  // FFDA.
  for (size_t at = 2; whole.number(at, 1) == 0xFF && whole.number(at, 2) != 0xFFDA;) {
    const size_t length = whole.number(at + 2, 2);
    if (length < 2 || at + 2 + length > jpeg.size()) return {};
    const std::string_view content = jpeg.substr(at + 4, length - 2);
    if (whole.number(at, 2) == 0xFFE1 && content.starts_with(std::string_view("Exif\0\0", 6)))
      return {content.substr(6), content.substr(6).starts_with("MM")};
    at += 2 + length;
  }
  return {};
}

// The value of the key in the metadata of a video file or of one of its streams.
template <size_t count>
std::string said_of(const std::filesystem::path& video,
                    const std::array<const char*, count>& keys) {
  const auto file = ffmpeg::opened(video);
  if (!file) return {};
  const AVDictionaryEntry* entry = nullptr;
  for (const char* key : keys) {
    if (!entry) entry = av_dict_get(file->metadata, key, nullptr, 0);
    for (unsigned i = 0; !entry && i < file->nb_streams; ++i)
      entry = av_dict_get(file->streams[i]->metadata, key, nullptr, 0);
  }
  return entry ? entry->value : "";
}

// The beginning of the first image file; "" for a video.
std::string first_image(const std::filesystem::path& path) {
  std::vector<std::filesystem::path> images;
  try {
    images = image_files(path);
  } catch (const InputError&) {
    return {};
  }
  if (images.empty()) return {};
  std::ifstream file(images.front(), std::ios::binary);
  std::string bytes(kExifBytes, '\0');
  file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<size_t>(file.gcount()));
  return bytes;
}

}  // namespace

std::optional<double> exif_focal_length_35mm(std::string_view jpeg) {
  return focal_length(exif_of(jpeg));
}

std::string exif_model(std::string_view jpeg) { return model(exif_of(jpeg)); }

std::optional<double> focal_length_35mm(const std::filesystem::path& path) {
  if (std::filesystem::is_regular_file(path))
    if (const auto number = number_from_text(said_of(path, std::array{kAppleKey})))
      if (const auto found = lens(*number)) return found;
  return exif_focal_length_35mm(first_image(path));
}

std::string camera_model(const std::filesystem::path& path) {
  std::string said;
  if (std::filesystem::is_regular_file(path)) said = name_of(said_of(path, kModelKeys));
  return said.empty() ? exif_model(first_image(path)) : said;
}

std::optional<double> telephone_focal_length_35mm(std::string_view model) {
  const auto* const found =
      std::find_if(kTelephones.begin(), kTelephones.end(),
                   [&](const Telephone& telephone) { return model.starts_with(telephone.name); });
  return found != kTelephones.end() ? std::optional(found->focal_mm) : std::nullopt;
}

}  // namespace io
}  // namespace walktrack
