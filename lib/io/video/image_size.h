// The size of an image according to its file's header, which is checked before anything is decoded,
// because a few bytes can demand gigabytes. PNG, JPEG, TIFF, BMP, PNM and WebP are recognised by
// content.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

namespace walktrack {
inline namespace io {

struct StatedSize {
  int64_t width = 0, height = 0;  // px
};

// `bytes`: the whole file (for JPEG and TIFF the header may be anywhere). nullopt for other
// formats, truncated headers and sizes below one pixel.
std::optional<StatedSize> image_size_from_header(std::span<const unsigned char> bytes);

}  // namespace io
}  // namespace walktrack
