// Writes a video that appears complete or not at all: frames go to a temporary file beside it;
// close() checks, flushes and renames it. H.264 in MP4; the same frames give the same bytes on
// every machine, whatever its number of cores (H264File).
#pragma once

#include <filesystem>
#include <memory>

#include <opencv2/core/mat.hpp>

#include "io/video/encoder_preset.h"

namespace walktrack {
inline namespace io {

class H264File;

class VideoWriter {
 public:
  // Sizes are those of the frames, px; odd ones lose their last row or column. Throws
  // std::runtime_error if no encoder opens.
  VideoWriter(const std::filesystem::path& path, cv::Size size_px, double frame_rate,
              EncoderPreset preset = EncoderPreset::kMedium);
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
  std::unique_ptr<H264File> encoder_;  // none once closed
};

}  // namespace io
}  // namespace walktrack
