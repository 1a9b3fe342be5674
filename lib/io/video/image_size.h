// Size of an image as its file's header states it, before anything is decoded: a few bytes can ask
// for gigabytes. Knows PNG, JPEG, TIFF, BMP, PNM and WebP by their content, whatever the file is
// called, and no other format.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

namespace walktrack {
inline namespace io {

struct StatedSize {
  int64_t width = 0, height = 0;  // px
};

// Of the whole file's bytes (for JPEG and TIFF the header may stand anywhere); nullopt for other
// formats, cut-off headers and sizes below one pixel.
std::optional<StatedSize> image_size_from_header(std::span<const unsigned char> bytes);

}  // namespace io
}  // namespace walktrack
