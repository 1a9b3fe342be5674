// Decodes the frames of a video file one after another, by FFmpeg. A frame is converted to colours
// when it is asked for, and only the part and at the size that is asked for.
#pragma once

#include <filesystem>
#include <memory>

#include <opencv2/core/mat.hpp>

namespace walktrack {
inline namespace io {

class VideoDecoder {
 public:
  // nullptr if FFmpeg cannot decode the file.
  static std::unique_ptr<VideoDecoder> open(const std::filesystem::path& path);
  ~VideoDecoder();
  VideoDecoder(const VideoDecoder&) = delete;
  VideoDecoder& operator=(const VideoDecoder&) = delete;

  // According to the container; 0 = unknown.
  cv::Size size_px() const;
  double frame_rate() const;  // Hz
  int frame_count() const;
  // The clockwise rotation that shows the video upright: 0, 90, 180 or 270.
  int rotation_deg() const;

  // Decodes the next frame; false if there is none. Packets that cannot be decoded are left out.
  bool advance();
  // The size of the frame that was decoded.
  cv::Size frame_px() const;
  // That frame, 8-bit BGR, not turned: all of it, or an area of it, shrunk by an integer factor as
  // by shrunk() of observation/shrink.h (within rounding). `bgr` keeps its memory.
  void picture(cv::Mat& bgr) const;
  void picture(const cv::Rect& area, int shrink, cv::Mat& bgr) const;
  // The latter with every pixel converted before it is shrunk: the same bytes as shrunk(). An
  // 8-bit YUV 4:2:0 frame is converted and shrunk strip by strip, without a full-size copy.
  void means_of_pixels(const cv::Rect& area, int shrink, cv::Mat& bgr) const;

 private:
  struct State;
  explicit VideoDecoder(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace io
}  // namespace walktrack
