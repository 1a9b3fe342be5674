#include "io/video/scene_video.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <opencv2/core.hpp>

#include "core/errors.h"
#include "io/keypoints/keypoint_file.h"

namespace walktrack {

namespace {

// Rates that differ by less drift by less than half a frame in an hour at 60 Hz.
constexpr double kSameRate = 2e-6;
// Stamps of a file whose own rate differs by more from the stated one are a guess like that rate.
constexpr double kStampsBelieved = 0.1;

// How many frames' times a source has gone on with its last frame: 1, more after dropped frames. A
// stamp that stands still takes back one that came too early; the last frames of a file may have
// none (0).
int frames_passed(double stamp, double before, double rate) {
  if (!std::isfinite(stamp) || stamp <= 0 || stamp < before) return 1;
  return static_cast<int>(std::lround((stamp - before) * rate));
}

cv::Size size_of(const SceneCamera& camera) {
  return {camera.camera.width_px, camera.camera.height_px};
}

}  // namespace

FrameSource plain_frames(const SceneCamera& camera) {
  return FrameSource(size_of(camera), read_keypoints(camera.keypoints).people.rbegin()->first + 1);
}

SceneVideo::SceneVideo(const Scene& scene)
    : first_frame_(scene.first_frame), next_frame_(scene.first_frame) {
  last_frame_ = scene.last_frame;
  for (const SceneCamera& camera : scene.cameras) {
    sources_.push_back(camera.video.empty() ? plain_frames(camera)
                                            : FrameSource(camera.video, size_of(camera)));
    start_frames_.push_back(camera.start_frame);
  }
  rate_ = scene.frame_rate.value_or(sources_.front().facts().frame_rate);
  if (!(rate_ > 0)) {
    throw InputError(describe({scene.file.string(), 0, "frame_rate"}, "nothing",
                              "a rate in Hz, for the frames are images without one"));
  }
  for (size_t i = 0; i < sources_.size(); ++i) {
    // A rate given for the whole scene wins over the container's, which is often a guess.
    const double own = scene.frame_rate ? rate_ : sources_[i].facts().frame_rate;
    rates_.push_back(scene.cameras[i].frame_rate.value_or(own > 0 ? own : rate_));
    if (std::abs(rates_[i] / rate_ - 1) < kSameRate) rates_[i] = rate_;
  }
  ahead_.resize(sources_.size());
  if (frame_count() < 0) {
    throw InputError(describe({scene.file.string(), 0, "first_frame"}, std::to_string(first_frame_),
                              "a frame before the videos' end"));
  }
}

int SceneVideo::camera_frame(size_t camera, int scene_frame) const {
  const double frames = scene_frame * (rates_[camera] / rate_);
  return start_frames_[camera] + static_cast<int>(std::lround(frames));
}

int SceneVideo::frame_count() const {
  double end = last_frame_ ? *last_frame_ + 1.0 : std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < sources_.size(); ++i) {
    const int count = sources_[i].facts().frame_count;
    if (count == 0) continue;
    // The last scene frame whose rounded camera frame exists.
    const double last = (count - 0.5 - start_frames_[i]) * (rate_ / rates_[i]);
    end = std::min(end, rates_[i] == rate_ ? double(count - start_frames_[i]) : std::ceil(last));
  }
  if (std::isinf(end)) return 0;
  const int frames = static_cast<int>(end) - first_frame_;
  return frames > 0 ? frames : -1;
}

bool SceneVideo::read_ahead(size_t camera) {
  FrameSource& source = sources_[camera];
  Ahead& ahead = ahead_[camera];
  if (!source.read(ahead.image)) {
    trouble_ = source.trouble();
    return false;
  }
  const double rate = rates_[camera], stamp = source.time();
  const bool believed = std::abs(source.facts().frame_rate / rate - 1) <= kStampsBelieved;
  const bool first = ahead.number < 0;
  ahead.number += first || !believed ? 1 : frames_passed(stamp, ahead.stamp, rate);
  ahead.number += source.missing_before();
  ahead.source = source.number();
  if (first || stamp > ahead.stamp) ahead.stamp = stamp;
  ahead.waits = true;
  return true;
}

bool SceneVideo::advance(size_t camera, SceneFrames& frames) {
  Ahead& ahead = ahead_[camera];
  const int wanted = camera_frame(camera, next_frame_);
  frames.fresh[camera] = false;
  for (;;) {
    if (ahead.waits && ahead.number <= wanted) {
      cv::swap(frames.images[camera], ahead.image);
      frames.fresh[camera] = true;
      frames.source[camera] = ahead.source;
      ahead.waits = false;
    }
    if (ahead.number >= wanted) return true;
    if (!read_ahead(camera)) return false;
  }
}

bool SceneVideo::read(SceneFrames& frames) {
  if (!trouble_.empty() || (last_frame_ && next_frame_ > *last_frame_)) return false;
  frames.images.resize(sources_.size());
  frames.fresh.resize(sources_.size());
  frames.source.resize(sources_.size());
  for (size_t i = 0; i < sources_.size(); ++i) {
    if (!advance(i, frames)) return false;
  }
  frames.number = next_frame_;
  frames.time = (next_frame_ - first_frame_) / rate_;
  ++next_frame_;
  return true;
}

}  // namespace walktrack
