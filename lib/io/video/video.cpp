#include "io/video/video.h"

#include <cmath>
#include <numeric>

#include <fmt/format.h>
#include <opencv2/core/utility.hpp>
#include <opencv2/videoio.hpp>

#include "core/errors.h"
#include "io/scene/scene.h"
#include "io/video/image_files.h"

namespace walktrack {
inline namespace io {

namespace fs = std::filesystem;

namespace {

// Containers estimate the number of frames from the duration, or count a last frame that no decoder
// returns.
int smallest_believable_count(int announced) { return announced - 2 - announced / 100; }

[[noreturn]] void fail(const fs::path& path, std::string_view found, std::string_view allowed) {
  throw InputError(describe({path.string(), 0, ""}, found, allowed));
}

std::string size_text(cv::Size size) { return fmt::format("{}x{}", size.width, size.height); }

int whole_property(cv::VideoCapture& capture, int property) {
  const double value = capture.get(property);
  return std::isfinite(value) && value > 0 && value < 1e9 ? static_cast<int>(value) : 0;
}

cv::Size frame_size(cv::VideoCapture& capture) {
  return {whole_property(capture, cv::CAP_PROP_FRAME_WIDTH),
          whole_property(capture, cv::CAP_PROP_FRAME_HEIGHT)};
}

// The clockwise rotation that shows the video upright. Only OpenCV 4.6.0 has its sign reversed
// (opencv issue 22088), which is also why frames are rotated here and not by OpenCV.
int rotation_deg(cv::VideoCapture& capture) {
  const int turn = whole_property(capture, cv::CAP_PROP_ORIENTATION_META) % 360;
  const bool reversed = cv::getVersionString() == "4.6.0";
  return reversed ? (360 - turn) % 360 : turn;
}

void turn(const cv::Mat& raw, int clockwise_deg, cv::Mat& turned) {
  if (clockwise_deg == 90) cv::rotate(raw, turned, cv::ROTATE_90_CLOCKWISE);
  if (clockwise_deg == 180) cv::rotate(raw, turned, cv::ROTATE_180);
  if (clockwise_deg == 270) cv::rotate(raw, turned, cv::ROTATE_90_COUNTERCLOCKWISE);
}

}  // namespace

FrameSource::FrameSource(const fs::path& path, std::optional<cv::Size> expected_px) : path_(path) {
  images_ = image_files(path);
  if (images_.empty()) {
    open_video(expected_px);
  } else {
    open_images();
  }
  check_size(expected_px);
}

FrameSource::FrameSource(cv::Size size_px, int frames) : plain_(cv::Mat::zeros(size_px, CV_8UC3)) {
  facts_.width_px = size_px.width;
  facts_.height_px = size_px.height;
  facts_.frame_count = frames;
}

FrameSource::~FrameSource() = default;
FrameSource::FrameSource(FrameSource&&) noexcept = default;

void FrameSource::open_video(std::optional<cv::Size> expected_px) {
  if (!fs::is_regular_file(path_)) fail(path_, "no file", "a video, images or a pattern");
  capture_ = std::make_unique<cv::VideoCapture>();
  if (!capture_->open(path_.string(), cv::CAP_FFMPEG)) {
    fail(path_, "no video that FFmpeg can decode", "a video file, images or a pattern");
  }
  capture_->set(cv::CAP_PROP_ORIENTATION_AUTO, 0);
  facts_.rotation_deg = rotation_deg(*capture_);
  cv::Size size = frame_size(*capture_);
  const bool swaps = facts_.rotation_deg % 180 != 0;
  const cv::Size turned = swaps ? cv::Size(size.height, size.width) : size;
  const bool only_raw_fits = expected_px && turned != *expected_px && size == *expected_px;
  facts_.rotated = facts_.rotation_deg != 0 && !only_raw_fits;
  if (facts_.rotated) size = turned;
  facts_.width_px = size.width;
  facts_.height_px = size.height;
  facts_.frame_count = whole_property(*capture_, cv::CAP_PROP_FRAME_COUNT);
  const double rate = capture_->get(cv::CAP_PROP_FPS);
  facts_.frame_rate = rate > 0 && rate <= kFastestRate ? rate : 0;
}

void FrameSource::open_images() {
  cv::Mat first;
  const std::string reason = read_image_file(images_.front(), first);
  if (!reason.empty()) fail(images_.front(), reason, "");
  facts_.width_px = first.cols;
  facts_.height_px = first.rows;
  missing_before_ = walktrack::missing_before(images_);
  facts_.missing = std::accumulate(missing_before_.begin(), missing_before_.end(), 0);
  facts_.frame_count = static_cast<int>(images_.size()) + facts_.missing;
}

void FrameSource::check_size(std::optional<cv::Size> expected_px) const {
  const cv::Size size(facts_.width_px, facts_.height_px);
  if (size.width < 1 || size.height < 1 || size.width > kMostPixelsAlongASide ||
      size.height > kMostPixelsAlongASide) {
    fail(path_, size_text(size) + " px", fmt::format("up to {} px", kMostPixelsAlongASide));
  }
  if (!expected_px || size == *expected_px) return;
  const bool swapped = size == cv::Size(expected_px->height, expected_px->width);
  fail(path_, size_text(size) + " px",
       fmt::format("{} px, the calibration's image size{}", size_text(*expected_px),
                   swapped ? " (width and height are swapped)" : ""));
}

bool FrameSource::read(cv::Mat& frame) {
  if (closed_ || !trouble_.empty()) return false;
  if (!images_.empty()) return read_image(frame);
  if (!plain_.empty()) {
    if (next_frame_ >= facts_.frame_count) return false;
    plain_.copyTo(frame);
    ++next_frame_;
    return true;
  }
  cv::Mat& decoded = facts_.rotated ? unturned_ : frame;
  if (!capture_->read(decoded) || decoded.empty()) {
    note_end();
    return false;
  }
  if (facts_.rotated) turn(unturned_, facts_.rotation_deg, frame);
  ++next_frame_;
  return true;
}

int FrameSource::number() const {
  const int place = next_frame_ - 1;
  if (images_.empty()) return place;
  return last_number_in(images_[static_cast<size_t>(place)].stem().string()).value_or(place);
}

bool FrameSource::read_image(cv::Mat& frame) {
  if (next_frame_ >= std::ssize(images_)) return false;
  const fs::path& file = images_[static_cast<size_t>(next_frame_)];
  const std::string reason = read_image_file(file, frame);
  if (!reason.empty()) {
    trouble_ = fmt::format("{}: frame {}: {}", file.string(), next_frame_, reason);
    return false;
  }
  if (frame.cols != facts_.width_px || frame.rows != facts_.height_px) {
    trouble_ = fmt::format("{}: frame {} is {} px, the first {}x{}", file.string(), next_frame_,
                           size_text(frame.size()), facts_.width_px, facts_.height_px);
    return false;
  }
  ++next_frame_;
  return true;
}

void FrameSource::close() {
  capture_.reset();
  unturned_.release();
  closed_ = true;
}

bool FrameSource::skip(int frames) {
  if (closed_) return false;
  for (int i = 0; i < frames; ++i) {
    if (!images_.empty()) {
      if (next_frame_ >= std::ssize(images_)) return false;
    } else if (!plain_.empty()) {
      if (next_frame_ >= facts_.frame_count) return false;
    } else if (!capture_->grab()) {
      note_end();
      return false;
    }
    ++next_frame_;
  }
  return true;
}

void FrameSource::note_end() {
  if (next_frame_ == 0) {
    trouble_ = fmt::format("{}: no frame can be decoded", path_.string());
  } else if (next_frame_ < smallest_believable_count(facts_.frame_count)) {
    trouble_ = fmt::format("{}: frame {} of {} cannot be decoded", path_.string(), next_frame_,
                           facts_.frame_count);
  }
}

}  // namespace io
}  // namespace walktrack
