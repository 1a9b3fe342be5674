#include "io/drawing/picture.h"

#include <algorithm>
#include <stdexcept>
#include <vector>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace walktrack {
inline namespace io {

namespace {

// OpenCV has no view of constant pixels; clone() only reads them.
Image copied(std::span<const uint8_t> pixels, int width, int height, int type) {
  return Image(height, width, type, const_cast<uint8_t*>(pixels.data())).clone();
}

}  // namespace

Image bgr_image(std::span<const uint8_t> pixels, int width, int height) {
  return copied(pixels, width, height, CV_8UC3);
}

Image grey_image(std::span<const uint8_t> pixels, int width, int height) {
  return copied(pixels, width, height, CV_8UC1);
}

Image black_image(int width, int height) { return Image::zeros(height, width, CV_8UC3); }

void fill(Image& image, int grey) { image = cv::Scalar::all(grey); }

Image dimmed(const Image& image, double share) { return share * image; }

std::string png_bytes(const Image& image) {
  std::vector<uchar> bytes;
  cv::imencode(".png", image, bytes);
  return {bytes.begin(), bytes.end()};
}

void write_picture(const std::filesystem::path& file, const Image& image) {
  if (!cv::imwrite(file.string(), image))
    throw std::runtime_error(file.string() + " cannot be written");
}

Image after_jpeg(const Image& image, int quality) {
  std::vector<uchar> coded;
  cv::imencode(".jpg", image, coded, {cv::IMWRITE_JPEG_QUALITY, quality});
  return cv::imdecode(coded, cv::IMREAD_COLOR);
}

Image enlarged(const Image& image, int factor) {
  Image large;
  cv::resize(image, large, {}, factor, factor, cv::INTER_NEAREST);
  return large;
}

Image beside(const Image& left, const Image& right) {
  const int rows = std::min(left.rows, right.rows);
  const auto lowered = [&](const Image& image) {
    Image out;
    cv::resize(image, out, cv::Size(image.cols * rows / image.rows, rows), 0, 0, cv::INTER_AREA);
    return out;
  };
  Image both;
  cv::hconcat(lowered(left), lowered(right), both);
  return both;
}

}  // namespace io
}  // namespace walktrack
