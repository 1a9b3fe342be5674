#include "io/drawing/picture.h"

#include <algorithm>
#include <stdexcept>
#include <vector>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace walktrack {
inline namespace io {

std::string png_bytes(const cv::Mat& image) {
  std::vector<uchar> bytes;
  cv::imencode(".png", image, bytes);
  return {bytes.begin(), bytes.end()};
}

void write_picture(const std::filesystem::path& file, const cv::Mat& image) {
  if (!cv::imwrite(file.string(), image))
    throw std::runtime_error(file.string() + " cannot be written");
}

cv::Mat after_jpeg(const cv::Mat& image, int quality) {
  std::vector<uchar> coded;
  cv::imencode(".jpg", image, coded, {cv::IMWRITE_JPEG_QUALITY, quality});
  return cv::imdecode(coded, cv::IMREAD_COLOR);
}

cv::Mat enlarged(const cv::Mat& image, int factor) {
  cv::Mat large;
  cv::resize(image, large, {}, factor, factor, cv::INTER_NEAREST);
  return large;
}

cv::Mat beside(const cv::Mat& left, const cv::Mat& right) {
  const int rows = std::min(left.rows, right.rows);
  const auto lowered = [&](const cv::Mat& image) {
    cv::Mat out;
    cv::resize(image, out, cv::Size(image.cols * rows / image.rows, rows), 0, 0, cv::INTER_AREA);
    return out;
  };
  cv::Mat both;
  cv::hconcat(lowered(left), lowered(right), both);
  return both;
}

}  // namespace io
}  // namespace walktrack
