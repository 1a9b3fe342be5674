#include "tests/io/sample_video.h"

#include <cmath>
#include <filesystem>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "io/video_writer.h"

namespace walktrack {

namespace {
constexpr double kLevelsPerNumber = 10;
}

cv::Mat sample_frame(int number) {
  return cv::Mat(48, 64, CV_8UC3, cv::Scalar::all(kLevelsPerNumber * (number % 25) + 5));
}

int shown_number(const cv::Mat& frame) {
  return static_cast<int>(std::lround((cv::mean(frame)[1] - 5) / kLevelsPerNumber));
}

void write_sample_video(const std::string& path, int frames) {
  VideoWriter writer(path, {64, 48}, 25);
  for (int i = 0; i < frames; ++i) writer.write(sample_frame(i));
  writer.close();
}

void write_sample_images(const std::string& folder, const std::vector<int>& numbers) {
  std::filesystem::create_directories(folder);
  for (const int number : numbers) {
    cv::imwrite(folder + "/frame" + std::to_string(number) + ".png", sample_frame(number));
  }
}

}  // namespace walktrack
