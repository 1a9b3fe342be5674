// Writes an MP4 file of H.264 with a chosen encoder preset, which OpenCV 4.6 does not allow. The
// encoder runs in the thread that writes, so that a file's bytes do not depend on the number of
// threads, and looks ahead by a few frames only, so that memory does not grow with the video.
#pragma once

#include <filesystem>
#include <memory>

#include <opencv2/core/mat.hpp>

#include "io/video/encoder_preset.h"

namespace walktrack {
inline namespace io {

class H264File {
 public:
  // nullptr if FFmpeg has no such encoder or it does not accept this size and rate. Sizes are even.
  static std::unique_ptr<H264File> open(const std::filesystem::path& path, cv::Size size_px,
                                        double frame_rate, EncoderPreset preset);
  ~H264File();
  H264File(const H264File&) = delete;
  H264File& operator=(const H264File&) = delete;

  // 8-bit BGR, at least of that size. Throws a std::runtime_error, without the file's name, if it
  // cannot be written.
  void write(const cv::Mat& frame);
  // To be called after the last frame; throws the same error.
  void finish();

 private:
  struct State;
  explicit H264File(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace io
}  // namespace walktrack
