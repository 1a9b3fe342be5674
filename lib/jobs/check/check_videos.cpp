#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <opencv2/core.hpp>

#include "io/video/scene_video.h"
#include "jobs/check/check_parts.h"

namespace walktrack {

namespace {

constexpr double kRateTolerance = 1e-3;  // 29.97 for 30 Hz passes; 25 for 24 does not
constexpr int kMostStamps = 2000;        // frames whose time stamps are looked at
constexpr double kEqualFrames = 5, kEqualShare = 0.02;  // of unequal lengths that are usual
constexpr double kUneven = 0.25;                        // of the median step between frames
constexpr double kUnevenShare = 0.02;                   // of the frames
constexpr double kFewUneven = 3;                        // decoders stumble at the start

// False if the frames have another size than the calibration's.
bool check_size(const SceneCamera& camera, const VideoFacts& video, CheckReport& report) {
  const int width = camera.camera.width_px, height = camera.camera.height_px;
  const bool fits = video.width_px == width && video.height_px == height;
  const bool raw_fits =
      video.rotation_deg % 180 != 0 && video.width_px == height && video.height_px == width;
  if (fits || raw_fits) {
    if (video.rotation_deg == 0) return true;
    report.findings.push_back(
        {camera.name, false,
         fmt::format("the video asks to be turned by {} degrees; frames are used {}",
                     video.rotation_deg, fits ? "turned, as players show them" : "as stored"),
         fits ? "the calibration must be of turned frames" : ""});
    return true;
  }
  const bool swapped = video.width_px == height && video.height_px == width;
  report.findings.push_back(
      {camera.name, true,
       fmt::format("frames are {}x{} px, the calibration is of {}x{} px", video.width_px,
                   video.height_px, width, height),
       swapped ? "width and height are swapped: calibrate frames that are turned as these, or swap "
                 "image_width and image_height if only they are wrong"
               : "use the calibration of this resolution; for a resized video scale focal length "
                 "and principal point with it"});
  return false;
}

// A container's rate is that of the frames it holds; `dropped` ones belong to the camera's.
void check_rate(const Scene& scene, const SceneCamera& camera, const VideoFacts& video, int dropped,
                double scene_rate, CheckReport& report) {
  if (video.frame_rate == 0) return;
  const double held = std::max(1, video.frame_count);
  const double rate = video.frame_rate * (held + dropped) / held;
  const double stated = camera.frame_rate.value_or(scene_rate);
  if (std::abs(rate / stated - 1) <= kRateTolerance) return;
  report.findings.push_back(
      {camera.name, true,
       fmt::format("the video says {:g} Hz, the scene {:g} Hz{}", rate, stated,
                   scene.frame_rate || camera.frame_rate ? "" : " (of its first camera)"),
       fmt::format("set frame_rate: {:g} for this camera, or convert the video", rate)});
}

void say_dropped(const SceneCamera& camera, int frames, const char* what, CheckReport& report) {
  if (frames == 0) return;
  report.findings.push_back({camera.name, false, fmt::format("{} {}", frames, what),
                             "tracking goes on without them; the others keep their time"});
}

// A rate that varies, and frames that were dropped: steps between time stamps that differ from
// their median, or are several of it. Hands back how many frames were dropped.
int check_steps_between_frames(const SceneCamera& camera, const std::vector<double>& steps,
                               CheckReport& report) {
  std::vector<double> sorted = steps;
  std::nth_element(sorted.begin(), sorted.begin() + std::ptrdiff_t(sorted.size() / 2),
                   sorted.end());
  const double median = sorted[sorted.size() / 2];
  int uneven = 0, missing = 0;
  for (const double step : steps) {
    const double whole = std::max(1.0, std::round(step / median));
    if (std::abs(step - whole * median) > kUneven * median) {
      ++uneven;
    } else {
      missing += static_cast<int>(whole) - 1;
    }
  }
  say_dropped(camera, missing, "frames were dropped", report);
  const double allowed = std::max(kFewUneven, kUnevenShare * static_cast<double>(steps.size()));
  if (uneven <= allowed) return missing;
  report.findings.push_back(
      {camera.name, true,
       fmt::format("the frame rate varies: {} of {} steps between frames are uneven", uneven,
                   steps.size()),
       "convert to a constant rate, e.g. ffmpeg -i in.mp4 -vf fps=30 out.mp4"});
  return missing;
}

// The number of dropped frames among those whose stamps are looked at.
int check_stamps(const SceneCamera& camera, FrameSource& source, CheckReport& report) {
  std::vector<double> steps;
  cv::Mat frame;
  double last = NAN;
  for (int i = 0; i < kMostStamps && source.skip(1); ++i) {
    const double stamp = source.time();
    if (std::isfinite(stamp - last)) steps.push_back(stamp - last);
    last = stamp;
  }
  if (!source.trouble().empty()) {
    report.findings.push_back(
        {camera.name, true, source.trouble(), "copy or convert the file again"});
  }
  return steps.size() < 3 ? 0 : check_steps_between_frames(camera, steps, report);
}

void check_lengths(const Scene& scene, CheckReport& report, double scene_rate) {
  double shortest = INFINITY, longest = 0;
  for (size_t i = 0; i < scene.cameras.size(); ++i) {
    const VideoFacts& video = report.cameras[i].video;
    if (video.frame_count == 0) return;
    const double rate = scene.cameras[i].frame_rate.value_or(scene_rate);
    const double seconds = (video.frame_count - scene.cameras[i].start_frame) / rate;
    shortest = std::min(shortest, seconds);
    longest = std::max(longest, seconds);
  }
  const double allowed = std::max(kEqualFrames / scene_rate, kEqualShare * longest);
  const bool range_is_stated =
      scene.last_frame && (*scene.last_frame + 1) / scene_rate <= shortest + 1e-9;
  if (longest - shortest <= allowed || range_is_stated) return;
  report.findings.push_back(
      {"", true,
       fmt::format("videos last from {:.2f} s to {:.2f} s after their start frames", shortest,
                   longest),
       "cut them to one span, or state last_frame; check start_frame of each camera"});
}

}  // namespace

bool check_videos(const Scene& scene, const JobControl& control, CheckReport& report) {
  double scene_rate = scene.frame_rate.value_or(0);
  bool sizes_fit = true;
  for (size_t i = 0; i < scene.cameras.size() && !control.stopping(); ++i) {
    control.progress("checking videos", i, scene.cameras.size());
    const SceneCamera& camera = scene.cameras[i];
    FrameSource source = camera.video.empty() ? plain_frames(camera) : FrameSource(camera.video);
    const VideoFacts video = source.facts();
    report.cameras[i].video = video;
    if (scene_rate == 0) scene_rate = video.frame_rate;
    sizes_fit &= check_size(camera, video, report);
    if (scene_rate == 0) {
      report.findings.push_back(
          {"", true, "no frame rate: the frames are images", "state frame_rate in the scene"});
      return false;
    }
    say_dropped(camera, video.missing, "images are missing, by the numbers in their names", report);
    const int dropped = check_stamps(camera, source, report);
    check_rate(scene, camera, video, dropped, scene_rate, report);
  }
  check_lengths(scene, report, scene_rate);
  return sizes_fit;
}

}  // namespace walktrack
