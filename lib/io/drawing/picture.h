// Writes and combines images for code that does not access pixels. Images are 8-bit, BGR or grey.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "observation/image.h"

namespace walktrack {
inline namespace io {

// Images of this size with copies of these pixels, row by row: BGR, and grey.
Image bgr_image(std::span<const uint8_t> pixels, int width, int height);
Image grey_image(std::span<const uint8_t> pixels, int width, int height);

// A black BGR image.
Image black_image(int width, int height);

// Sets all pixels of a BGR image to one grey level.
void fill(Image& image, int grey);

// The image with all values multiplied by `share`.
Image dimmed(const Image& image, double share);

// The content of a PNG file.
std::string png_bytes(const Image& image);

// Writes an image file in the format of the name's ending, e.g. ".bmp". Throws a std::runtime_error
// that names a file that cannot be written.
void write_picture(const std::filesystem::path& file, const Image& image);

// The image after JPEG compression with a quality of 1 to 100.
Image after_jpeg(const Image& image, int quality);

// The image with every pixel as a block of `factor` by `factor` pixels.
Image enlarged(const Image& image, int factor);

// Both images side by side, with the height of the lower one.
Image beside(const Image& left, const Image& right);

}  // namespace io
}  // namespace walktrack
