// Pictures as files and beside each other, for those who make pictures and look into none. Images
// are 8-bit, BGR or grey.
#pragma once

#include <filesystem>
#include <string>

#include <opencv2/core/mat.hpp>

namespace walktrack {
inline namespace io {

// A PNG file's content.
std::string png_bytes(const cv::Mat& image);

// Of the kind that the name's ending says, e.g. ".bmp". std::runtime_error naming a file that
// cannot be written.
void write_picture(const std::filesystem::path& file, const cv::Mat& image);

// What is left of a picture that went through JPEG of a quality of 1 to 100.
cv::Mat after_jpeg(const cv::Mat& image, int quality);

// With every pixel as a block of `factor` by `factor`.
cv::Mat enlarged(const cv::Mat& image, int factor);

// Both beside each other, as high as the lower one.
cv::Mat beside(const cv::Mat& left, const cv::Mat& right);

}  // namespace io
}  // namespace walktrack
