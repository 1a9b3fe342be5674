// Frames one after another, one in memory at a time: from a video file (FFmpeg), a folder of images
// in natural order (frame2 before frame10; a number that is left out is a dropped frame), a printf
// pattern (frames/%05d.png, numbered without gaps) or a single image.
//
// A frame number counts from 0 at the first frame of the source. Nothing is ever seeked: seeking in
// compressed video is inexact, so frames before the wanted one are decoded and dropped.
//
// Images that change their size are trouble of that frame. Of a video that does so in mid-stream
// OpenCV 4.6 passes frames on in the first one's size, cut off or filled up, and does not tell.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "io/video/video_facts.h"

namespace cv {
class VideoCapture;
}

namespace walktrack {
inline namespace io {

class FrameSource {
 public:
  // Opens the source; InputError naming file and reason if it cannot be read or has no frame.
  // With `expected_px` (the calibration's image size) a video that asks to be turned is turned
  // unless only the raw size fits; if neither fits, that is an InputError.
  explicit FrameSource(const std::filesystem::path& path,
                       std::optional<cv::Size> expected_px = std::nullopt);
  // Plain pictures where there is no video: what is drawn on them can be looked at.
  FrameSource(cv::Size size_px, int frames);
  ~FrameSource();
  FrameSource(FrameSource&&) noexcept;
  FrameSource& operator=(FrameSource&&) noexcept;

  const VideoFacts& facts() const { return facts_; }
  int next_frame() const { return next_frame_; }
  // What the last frame read is called: the number in its image's name where that has one,
  // otherwise its place in the source, from 0.
  int number() const;
  // How many images are missing before each; empty for a video.
  const std::vector<int>& missing_images() const { return missing_before_; }

  // The next frame, 8-bit BGR; overwritten by the next call, so clone it to keep it. False at the
  // end and when a frame cannot be read: then trouble() says which and why.
  bool read(cv::Mat& frame);
  // Passes over frames; false if the source ends before.
  bool skip(int frames);
  // Why the source ended before its announced end; empty if it did not.
  const std::string& trouble() const { return trouble_; }
  // Gives back what decoding holds: tens of pictures. No frame can be read any more.
  void close();

 private:
  void open_video(std::optional<cv::Size> expected_px);
  void open_images();
  void check_size(std::optional<cv::Size> expected_px) const;
  bool read_image(cv::Mat& frame);
  void note_end();

  std::filesystem::path path_;
  std::unique_ptr<cv::VideoCapture> capture_;  // a video file, or
  std::vector<std::filesystem::path> images_;  // image files in order, or
  std::vector<int> missing_before_;            // each of them
  cv::Mat plain_;                              // a plain picture
  cv::Mat unturned_;                           // the decoded frame where frames are turned
  VideoFacts facts_;
  int next_frame_ = 0;
  bool closed_ = false;
  std::string trouble_;
};

// The image files of a folder in natural order, of a pattern in the order of its numbers, or the
// one image. InputError if there is none, or if a number of a pattern is missing.
std::vector<std::filesystem::path> image_files(const std::filesystem::path& path);

// How many are missing before each image, where names differ in one number alone and its smallest
// step is the usual one; zeros where names say nothing, or where more were missing than are there.
std::vector<int> missing_before(const std::vector<std::filesystem::path>& images);

// Decodes one image file into 8-bit BGR, turned as its EXIF data asks. Says why it cannot be; empty
// if it was. A header that asks for more than kMostPixelsAlongASide is refused before decoding.
std::string read_image_file(const std::filesystem::path& path, cv::Mat& image);

inline constexpr int kMostPixelsAlongASide = 8192;

// The last number in a name without its extension; nothing where there is none, or one that is no
// frame's.
std::optional<int> last_number_in(std::string_view name);
inline constexpr int kLargestFrameNumber = 100'000'000;

// "frame2" before "frame10": runs of digits compare as numbers.
bool natural_less(const std::string& a, const std::string& b);

}  // namespace io
}  // namespace walktrack
