// Images in files: those of a folder or a pattern in their order, the numbers in their names, and
// their contents.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <opencv2/core/mat.hpp>

namespace walktrack {
inline namespace io {

// The image files of a folder in natural order, of a pattern in the order of its numbers, or the
// single image. Throws an InputError if there is none, or if a number of a pattern is missing.
std::vector<std::filesystem::path> image_files(const std::filesystem::path& path);

// Number of images that are missing before each one, if the names differ in one number only and its
// smallest step is the most frequent one; zeros if names have no such number, or if more images
// would be missing than present.
std::vector<int> missing_before(const std::vector<std::filesystem::path>& images);

// Decodes one image file into 8-bit BGR, rotated according to its EXIF data. Returns the error, or
// "" on success. A size above kMostPixelsAlongASide in the header is refused before decoding.
std::string read_image_file(const std::filesystem::path& path, cv::Mat& image);

inline constexpr int kMostPixelsAlongASide = 8192;

// The last number in a name without its extension; nullopt if there is none, or if it cannot be the
// number of a frame.
std::optional<int> last_number_in(std::string_view name);
inline constexpr int kLargestFrameNumber = 100'000'000;

// "frame2" before "frame10": runs of digits compare as numbers.
bool natural_less(const std::string& a, const std::string& b);

}  // namespace io
}  // namespace walktrack
