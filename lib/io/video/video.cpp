#include "io/video/video.h"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>
#include <opencv2/core.hpp>

#include "core/errors.h"
#include "io/ffmpeg/video_decoder.h"
#include "io/scene/scene.h"
#include "io/video/image_files.h"
#include "observation/shrink.h"

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

// Videos are shrunk before they are converted from this factor on. Below it little time is saved,
// and the tracker was measured with pictures that are converted first (tests/bench/README.md).
constexpr int kShrunkFirst = 8;

std::string size_text(cv::Size size) { return fmt::format("{}x{}", size.width, size.height); }

void turn(const cv::Mat& raw, int clockwise_deg, cv::Mat& turned) {
  if (clockwise_deg == 90) cv::rotate(raw, turned, cv::ROTATE_90_CLOCKWISE);
  if (clockwise_deg == 180) cv::rotate(raw, turned, cv::ROTATE_180);
  if (clockwise_deg == 270) cv::rotate(raw, turned, cv::ROTATE_90_COUNTERCLOCKWISE);
}

// The part of a raw frame of that size which is `area` after the rotation.
cv::Rect before_turn(const cv::Rect& area, int clockwise_deg, cv::Size raw) {
  const int right = area.x + area.width, bottom = area.y + area.height;
  if (clockwise_deg == 90) return {area.y, raw.height - right, area.height, area.width};
  if (clockwise_deg == 180)
    return {raw.width - right, raw.height - bottom, area.width, area.height};
  return {raw.width - bottom, area.x, area.height, area.width};
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

FrameSource::FrameSource(cv::Mat image, int frames) : image_(std::move(image)) {
  facts_.width_px = image_.cols;
  facts_.height_px = image_.rows;
  facts_.frame_count = frames;
}

FrameSource::~FrameSource() = default;
FrameSource::FrameSource(FrameSource&&) noexcept = default;

void FrameSource::open_video(std::optional<cv::Size> expected_px) {
  if (!fs::is_regular_file(path_)) fail(path_, "no file", "a video, images or a pattern");
  decoder_ = VideoDecoder::open(path_);
  if (!decoder_)
    fail(path_, "no video that FFmpeg can decode", "a video file, images or a pattern");
  facts_.rotation_deg = decoder_->rotation_deg();
  cv::Size size = decoder_->size_px();
  const bool swaps = facts_.rotation_deg % 180 != 0;
  const cv::Size turned = swaps ? cv::Size(size.height, size.width) : size;
  const bool only_raw_fits = expected_px && turned != *expected_px && size == *expected_px;
  facts_.rotated = facts_.rotation_deg != 0 && !only_raw_fits;
  if (facts_.rotated) size = turned;
  size_px_ = decoder_->size_px();
  facts_.width_px = size.width;
  facts_.height_px = size.height;
  facts_.frame_count = decoder_->frame_count();
  const double rate = decoder_->frame_rate();
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

bool FrameSource::advance() {
  if (closed_ || !trouble_.empty()) return false;
  if (!images_.empty()) return advance_image();
  if (decoder_) return advance_video();
  if (next_frame_ >= facts_.frame_count) return false;
  ++next_frame_;
  return true;
}

bool FrameSource::advance_video() {
  if (!decoder_->advance()) {
    note_end();
    return false;
  }
  return is_first_size(path_, decoder_->frame_px(), size_px_);
}

// Counts the frame if it has the size of the first one.
bool FrameSource::is_first_size(const fs::path& file, cv::Size size, cv::Size first) {
  if (size != first) {
    trouble_ = fmt::format("{}: frame {} is {} px, the first {}", file.string(), next_frame_,
                           size_text(size), size_text(first));
    return false;
  }
  ++next_frame_;
  return true;
}

bool FrameSource::read(cv::Mat& frame) {
  if (!advance()) return false;
  picture(frame);
  return true;
}

void FrameSource::picture(cv::Mat& out) const {
  if (!decoder_) return image_.copyTo(out);
  if (!facts_.rotated) return decoder_->picture(out);
  cv::Mat raw;
  decoder_->picture(raw);
  turn(raw, facts_.rotation_deg, out);
}

void FrameSource::picture(int shrink, cv::Mat& out) const {
  if (shrink == 1) return picture(out);
  const auto whole = [&](int length) { return length / shrink * shrink; };
  shrunk_picture({0, 0, whole(facts_.width_px), whole(facts_.height_px)}, shrink,
                 shrink < kShrunkFirst, out);
}

void FrameSource::picture(const cv::Rect& area, int shrink, cv::Mat& out) const {
  shrunk_picture(area, shrink, false, out);
}

// `converted`: every pixel is converted to colours before it is shrunk.
void FrameSource::shrunk_picture(const cv::Rect& area, int shrink, bool converted,
                                 cv::Mat& out) const {
  if (!decoder_) return shrunk(image_(area), shrink).copyTo(out);
  const auto make = [&](const cv::Rect& part, cv::Mat& made) {
    if (converted) return decoder_->means_of_pixels(part, shrink, made);
    decoder_->picture(part, shrink, made);
  };
  if (!facts_.rotated) return make(area, out);
  cv::Mat raw;
  make(before_turn(area, facts_.rotation_deg, decoder_->frame_px()), raw);
  turn(raw, facts_.rotation_deg, out);
}

int FrameSource::number() const {
  const int place = next_frame_ - 1;
  if (images_.empty()) return place;
  return last_number_in(images_[static_cast<size_t>(place)].stem().string()).value_or(place);
}

bool FrameSource::advance_image() {
  if (next_frame_ >= std::ssize(images_)) return false;
  const fs::path& file = images_[static_cast<size_t>(next_frame_)];
  const std::string reason = read_image_file(file, image_);
  if (!reason.empty()) {
    trouble_ = fmt::format("{}: frame {}: {}", file.string(), next_frame_, reason);
    return false;
  }
  return is_first_size(file, image_.size(), {facts_.width_px, facts_.height_px});
}

void FrameSource::close() {
  decoder_.reset();
  image_.release();
  closed_ = true;
}

bool FrameSource::skip(int frames) {
  if (closed_) return false;
  if (!images_.empty()) {  // which need not be read
    const int left = static_cast<int>(images_.size()) - next_frame_;
    next_frame_ += std::min(frames, left);
    return frames <= left;
  }
  for (int i = 0; i < frames; ++i)
    if (!advance()) return false;
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
