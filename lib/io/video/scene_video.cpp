#include "io/video/scene_video.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <opencv2/core.hpp>

#include "core/errors.h"
#include "io/ffmpeg/frame_stamps.h"
#include "io/keypoints/keypoint_file.h"

namespace walktrack {
inline namespace io {

namespace {

// Rates that differ by less than this drift by less than half a frame in an hour at 60 Hz.
constexpr double kSameRate = 2e-6;
// Time stamps are not used if their usual rate differs by more than this share from the stated one.
constexpr double kStampsBelieved = 0.1;
constexpr double kRounding = 1e-3, kHalf = 0.5 + kRounding;  // frames; time stamps are rounded

// Positions in frames from time stamps or from the numbers of images; empty if there are neither.
std::vector<double> places_from(const std::vector<double>& stamps, double usual) {
  std::vector<double> places;
  for (const double stamp : stamps) places.push_back(stamp / usual);
  return places;
}

std::vector<double> places_from(const FrameSource& source) {
  std::vector<double> places;
  double place = -1;
  for (const int missing : source.missing_images()) places.push_back(place += 1 + missing);
  return places;
}

cv::Size size_of(const SceneCamera& camera) {
  return {camera.camera.width_px, camera.camera.height_px};
}

}  // namespace

FrameSource plain_frames(const SceneCamera& camera) {
  return FrameSource(cv::Mat::zeros(size_of(camera), CV_8UC3),
                     read_keypoints(camera.keypoints).people.rbegin()->first + 1);
}

SceneVideo::SceneVideo(const Scene& scene)
    : first_frame_(scene.first_frame), next_frame_(scene.first_frame) {
  last_frame_ = scene.last_frame;
  for (const SceneCamera& camera : scene.cameras) {
    sources_.push_back(camera.video.empty() ? plain_frames(camera)
                                            : FrameSource(camera.video, size_of(camera)));
    start_frames_.push_back(camera.start_frame);
  }
  for (size_t i = 0; i < sources_.size(); ++i) place_frames(i, scene);
  for (double& rate : rates_)
    if (std::abs(rate / rate_ - 1) < kSameRate) rate = rate_;
  shown_.assign(sources_.size(), -1);
  refuse_late_starts(scene);
  if (frame_count() < 0) {
    throw InputError(describe({scene.file.string(), 0, "first_frame"}, std::to_string(first_frame_),
                              "a frame before the videos' end"));
  }
  refuse_late_times(scene);
}

void SceneVideo::refuse_late_starts(const Scene& scene) const {
  for (size_t i = 0; i < sources_.size(); ++i) {
    const int held = sources_[i].facts().frame_count;
    if (held > 0 && start_frames_[i] >= held)
      throw InputError(describe(
          {scene.file.string(), 0, fmt::format("cameras[{}].start_frame", i)},
          std::to_string(start_frames_[i]),
          fmt::format("less than {}, the frames of {}", held, scene.cameras[i].video.string())));
  }
}

void SceneVideo::refuse_late_times(const Scene& scene) const {
  const int frames = frame_count();
  const auto refuse = [&](const char* key, double time) {
    if (frames > 0 && time * rate_ >= frames)
      throw InputError(describe({scene.file.string(), 0, key}, fmt::format("{:g} s", time),
                                fmt::format("less than {:.2f} s, the time from first_frame to the "
                                            "end",
                                            frames / rate_)));
  };
  if (scene.initial) refuse("initial.time", scene.initial->time);
  if (scene.near) refuse("subject.near.time", scene.near->time);
}

// Determines the camera's rate and when its frames were taken.
void SceneVideo::place_frames(size_t camera, const Scene& scene) {
  const std::vector<double> stamps = frame_stamps(scene.cameras[camera].video);
  const StampSteps steps = steps_of(stamps);
  const double own = usual_rate(sources_[camera].facts(), steps);
  if (camera == 0) rate_ = scene.frame_rate.value_or(own);
  if (!(rate_ > 0)) {
    throw InputError(describe({scene.file.string(), 0, "frame_rate"}, "nothing",
                              "a rate in Hz, for the frames are images without one"));
  }
  // A rate that the scene states takes precedence over the container's, which is often wrong.
  const double usual = scene.frame_rate || own == 0 ? rate_ : own;
  rates_.push_back(scene.cameras[camera].frame_rate.value_or(usual));
  const bool believed = steps.usual > 0 && std::abs(own / rates_[camera] - 1) <= kStampsBelieved;
  places_.push_back(believed ? places_from(stamps, steps.usual) : places_from(sources_[camera]));
}

// The position of the next scene frame, in frames of the camera.
double SceneVideo::wanted(size_t camera) const {
  return start_frames_[camera] + next_frame_ * (rates_[camera] / rate_);
}

double SceneVideo::place_of(size_t camera, int frame) const {
  const std::vector<double>& places = places_[camera];
  if (frame < std::ssize(places)) return places[static_cast<size_t>(frame)];
  return places.empty() ? frame
                        : places.back() + static_cast<double>(frame + 1 - std::ssize(places));
}

// The frame nearest to a position, but none that is more than half a frame after it; of two equally
// near frames, the later one.
int SceneVideo::nearest(size_t camera, double place) const {
  const auto ahead = [&](int frame) { return place_of(camera, frame) - place; };
  int frame = std::max(0, shown_[camera]);
  while (ahead(frame + 1) <= kHalf && ahead(frame + 1) + ahead(frame) <= kRounding) ++frame;
  return frame;
}

int SceneVideo::frame_count() const {
  double end = last_frame_ ? *last_frame_ + 1.0 : std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < sources_.size(); ++i) {
    const int held = sources_[i].facts().frame_count;
    if (held == 0) continue;
    const double count = places_[i].empty() ? held : std::round(places_[i].back()) + 1;
    // The last scene frame whose nearest camera frame exists.
    const double last = (count - 0.5 - start_frames_[i]) * (rate_ / rates_[i]);
    end = std::min(end, rates_[i] == rate_ ? count - start_frames_[i] : std::ceil(last));
  }
  if (std::isinf(end)) return 0;
  const int frames = static_cast<int>(end) - first_frame_;
  return frames > 0 ? frames : -1;
}

bool SceneVideo::advance(size_t camera, SceneFrames& frames) {
  const double place = wanted(camera);
  const int frame = nearest(camera, place), before = shown_[camera];
  frames.fresh[camera] = false;
  if (frame == before) return true;
  FrameSource& source = sources_[camera];
  if (!source.skip(frame - before - 1) || !source.advance()) {
    trouble_ = source.trouble();
    return false;
  }
  shown_[camera] = frame;
  frames.source[camera] = source.number();
  // After dropped frames the nearest frame that has not been shown yet may be the one before them,
  // which is too old.
  const double reach = kHalf * std::max(1.0, rates_[camera] / rate_);
  frames.fresh[camera] = place - place_of(camera, frame) <= reach;
  return true;
}

bool SceneVideo::read(SceneFrames& frames) {
  if (!trouble_.empty() || (last_frame_ && next_frame_ > *last_frame_)) return false;
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

void SceneVideo::close() {
  for (FrameSource& source : sources_) source.close();
}

}  // namespace io
}  // namespace walktrack
