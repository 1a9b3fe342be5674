// A video that appears complete or not at all: frames go to a temporary file beside it, close()
// checks it, flushes it and renames it. H.264 in MP4 where FFmpeg can encode it, else MPEG-4.
//
// Without a preset OpenCV encodes, as it always has: videos that something is measured on stay the
// same. With one H264File does.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include <opencv2/core/mat.hpp>

#include "io/video/encoder_preset.h"

namespace cv {
class VideoWriter;
}

namespace walktrack {
inline namespace io {

class H264File;

class VideoWriter {
 public:
  // Sizes are of the frames, px; odd ones lose their last row or column. Throws std::runtime_error
  // if no encoder opens.
  VideoWriter(const std::filesystem::path& path, cv::Size size_px, double frame_rate,
              std::optional<EncoderPreset> preset = std::nullopt);
  ~VideoWriter();  // without close(): removes what was written
  VideoWriter(VideoWriter&&) noexcept;
  VideoWriter& operator=(VideoWriter&&) = delete;

  // 8-bit BGR of the announced size. Throws std::runtime_error if an encoder says that it failed.
  void write(const cv::Mat& frame);
  // Throws std::runtime_error if the file does not hold all frames (e.g. the disk is full).
  void close();

 private:
  std::filesystem::path path_, temporary_;
  std::unique_ptr<H264File> chosen_;         // with a preset, or
  std::unique_ptr<cv::VideoWriter> writer_;  // without; neither once closed
  int frames_ = 0;
};

}  // namespace io
}  // namespace walktrack
