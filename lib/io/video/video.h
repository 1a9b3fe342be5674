// Reads frames one after another, with one in memory at a time: from a video file (FFmpeg), a
// folder of images in natural order (frame2 before frame10; a missing number is a dropped frame), a
// printf pattern (frames/%05d.png, without gaps) or a single image.
//
// Frame numbers count from 0 at the first frame of the source. There is no seeking, which is
// inexact in compressed video: frames before the wanted one are decoded and dropped.
//
// A frame of another size than the first is an error of that frame.
//
// A frame is decoded by advance() and converted to colours by picture(), at the size that is
// wanted: who skips it or wants it small pays for no more.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "io/video/video_facts.h"

namespace walktrack {
inline namespace io {

class VideoDecoder;

class FrameSource {
 public:
  // Opens the source. Throws an InputError that names the file and the reason if it cannot be read
  // or has no frame. `expected_px` is the image size of the calibration: a video with a rotation
  // flag is rotated unless only the raw size matches; if neither matches, that is an InputError.
  explicit FrameSource(const std::filesystem::path& path,
                       std::optional<cv::Size> expected_px = std::nullopt);
  // One image in every frame, 8-bit BGR.
  FrameSource(cv::Mat image, int frames);
  ~FrameSource();
  FrameSource(FrameSource&&) noexcept;

  const VideoFacts& facts() const { return facts_; }
  int next_frame() const { return next_frame_; }
  // Number of the last frame that was read: the number in its image's name if there is one,
  // otherwise its position in the source, from 0.
  int number() const;
  // How many images are missing before each; empty for a video.
  const std::vector<int>& missing_images() const { return missing_before_; }

  // Goes to the next frame. Returns false at the end and if a frame cannot be read; trouble() then
  // states which and why.
  bool advance();
  // That frame, 8-bit BGR: all of it; shrunk as by shrunk() of observation/shrink.h; or an area of
  // it, shrunk (within rounding the same). `out` keeps its memory. To be called by one thread at a
  // time.
  void picture(cv::Mat& out) const;
  void picture(int shrink, cv::Mat& out) const;
  void picture(const cv::Rect& area, int shrink, cv::Mat& out) const;
  // The next frame and all of its picture.
  bool read(cv::Mat& frame);
  // Skips frames; returns false if the source ends before.
  bool skip(int frames);
  // The reason why the source ended before its stated end; empty if it did not.
  const std::string& trouble() const { return trouble_; }
  // Frees the decoder, which holds tens of images. No frame can be read afterwards.
  void close();

 private:
  void open_video(std::optional<cv::Size> expected_px);
  void open_images();
  void check_size(std::optional<cv::Size> expected_px) const;
  bool advance_image();
  bool advance_video();
  bool is_first_size(const std::filesystem::path& file, cv::Size size, cv::Size first);
  void note_end();
  void shrunk_picture(const cv::Rect& area, int shrink, bool converted, cv::Mat& out) const;

  std::filesystem::path path_;
  std::unique_ptr<VideoDecoder> decoder_;      // of a video file, or
  std::vector<std::filesystem::path> images_;  // image files in order, or
  std::vector<int> missing_before_;            // before each of them
  cv::Mat image_;                              // one of them, or that of every frame
  cv::Size size_px_;                           // of the video as decoded
  VideoFacts facts_;
  int next_frame_ = 0;
  bool closed_ = false;
  std::string trouble_;
};

}  // namespace io
}  // namespace walktrack
