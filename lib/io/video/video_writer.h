// Writes a video that appears complete or not at all: frames go to a temporary file beside it;
// close() checks, flushes and renames it. H.264 in MP4 if FFmpeg can encode it, otherwise MPEG-4.
//
// Without a preset OpenCV encodes, so that the bytes of videos on which measurements depend stay
// the same. With a preset H264File does.
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
  // Sizes are those of the frames, px; odd ones lose their last row or column. Throws
  // std::runtime_error if no encoder opens.
  VideoWriter(const std::filesystem::path& path, cv::Size size_px, double frame_rate,
              std::optional<EncoderPreset> preset = std::nullopt);
  ~VideoWriter();  // without close(): removes the file
  VideoWriter(VideoWriter&&) noexcept;
  VideoWriter& operator=(VideoWriter&&) = delete;

  // 8-bit BGR of the stated size. Throws std::runtime_error if the encoder reports a failure.
  void write(const cv::Mat& frame);
  // Throws std::runtime_error if the file does not contain all frames (e.g. because the disk is
  // full).
  void close();

 private:
  std::filesystem::path path_, temporary_;
  std::unique_ptr<H264File> chosen_;         // with a preset, or
  std::unique_ptr<cv::VideoWriter> writer_;  // without one; neither once closed
  int frames_ = 0;
};

}  // namespace io
}  // namespace walktrack
