#include "jobs/check/check_videos.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "io/ffmpeg/frame_stamps.h"
#include "io/video/scene_video.h"
#include "io/video/video.h"

namespace walktrack {
inline namespace jobs {

namespace {

constexpr double kRateTolerance = 1e-3;  // relative; 29.97 for 30 Hz passes, 25 for 24 Hz does not
constexpr int kMostDecoded = 2000;       // frames of each video that are decoded
constexpr double kEqualFrames = 5, kEqualShare = 0.02;  // usual differences of length
constexpr double kUnevenShare = 0.02;                   // of the frames
constexpr double kFewUneven = 3;                        // decoders are irregular at the beginning

// Returns false if the frames have another size than the calibration.
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

// The timing of a video.
struct Timing {
  double rate = 0;    // Hz, of most frames; 0 = unknown
  double frames = 0;  // including dropped ones; 0 = unknown
  StampSteps steps;
};

Timing timing_of(const SceneCamera& camera, const VideoFacts& video) {
  const std::vector<double> stamps = frame_stamps(camera.video);
  Timing out;
  out.steps = steps_of(stamps);
  out.rate = usual_rate(video, out.steps);
  const bool stamped = out.steps.usual > 0;
  out.frames = stamped ? stamps.back() / out.steps.usual + 1 : video.frame_count;
  return out;
}

bool same_rate(double a, double b) { return std::abs(a / b - 1) <= kRateTolerance; }

// A rate that is stated for all cameras and differs from each of theirs.
bool check_common_rate(const Scene& scene, const std::vector<Timing>& timing, CheckReport& report) {
  const double own = timing.front().rate;
  if (!scene.frame_rate || own == 0 || same_rate(own, *scene.frame_rate)) return false;
  for (size_t i = 0; i < timing.size(); ++i)
    if (scene.cameras[i].frame_rate || timing[i].rate == 0 || !same_rate(timing[i].rate, own))
      return false;
  report.findings.push_back(
      {"", true,
       fmt::format("{} {:.6g} Hz, the scene {:g} Hz",
                   timing.size() == 1 ? "the video says" : "the videos say", own,
                   *scene.frame_rate),
       fmt::format("set frame_rate: {:.6g} in the scene; if the file is wrong, as of slow motion, "
                   "convert it to its true rate",
                   own)});
  return true;
}

void check_rate(const Scene& scene, const SceneCamera& camera, double own, double scene_rate,
                CheckReport& report) {
  const double stated = camera.frame_rate.value_or(scene_rate);
  if (own == 0 || same_rate(own, stated)) return;
  report.findings.push_back(
      {camera.name, true,
       fmt::format("the video says {:.6g} Hz, the scene {:g} Hz{}", own, stated,
                   scene.frame_rate || camera.frame_rate ? "" : " (of its first camera)"),
       fmt::format("set frame_rate: {:.6g} for this camera, or convert the video", own)});
}

void say_dropped(const SceneCamera& camera, int frames, const char* what, CheckReport& report) {
  if (frames == 0) return;
  report.findings.push_back({camera.name, false, fmt::format("{} {}", frames, what),
                             "tracking goes on without them; the others keep their time"});
}

// Reports dropped frames and a variable frame rate.
void check_steps_between_frames(const SceneCamera& camera, const StampSteps& steps, int frames,
                                CheckReport& report) {
  say_dropped(camera, steps.dropped, "frames were dropped", report);
  if (steps.uneven <= std::max(kFewUneven, kUnevenShare * frames)) return;
  report.findings.push_back(
      {camera.name, false,
       fmt::format("the frame rate varies: {} of {} steps between frames are uneven", steps.uneven,
                   frames - 1),
       "frames are taken at the time that they say, to half a step; a constant rate is safer"});
}

// Reports cameras that began together and did not end together: one of them may have lost frames.
void check_lengths(const Scene& scene, const std::vector<Timing>& timing, double scene_rate,
                   CheckReport& report) {
  double shortest = INFINITY, longest = 0;
  bool began_together = true;
  for (size_t i = 0; i < timing.size(); ++i) {
    if (timing[i].frames == 0) return;
    const SceneCamera& camera = scene.cameras[i];
    const double seconds =
        (timing[i].frames - camera.start_frame) / camera.frame_rate.value_or(scene_rate);
    began_together = began_together && camera.start_frame == 0;
    shortest = std::min(shortest, seconds);
    longest = std::max(longest, seconds);
  }
  const double allowed = std::max(kEqualFrames / scene_rate, kEqualShare * longest);
  const bool range_is_stated =
      scene.last_frame && (*scene.last_frame + 1) / scene_rate <= shortest + 1e-9;
  if (longest - shortest <= allowed || range_is_stated) return;
  report.findings.push_back(
      {"", began_together,
       fmt::format("videos last from {:.2f} s to {:.2f} s after their start frames", shortest,
                   longest),
       began_together ? "if one has lost frames, give it its time stamps back; if they began "
                        "unequally, set start_frame; if only their ends differ, state last_frame"
                      : "tracking ends with the shortest",
       began_together});
}

}  // namespace

bool check_videos(const Scene& scene, const JobControl& control, CheckReport& report) {
  double scene_rate = scene.frame_rate.value_or(0);
  bool sizes_fit = true;
  std::vector<Timing> timing;
  for (size_t i = 0; i < scene.cameras.size() && !control.stopping(); ++i) {
    const SceneCamera& camera = scene.cameras[i];
    FrameSource source = camera.video.empty() ? plain_frames(camera) : FrameSource(camera.video);
    const VideoFacts video = source.facts();
    report.cameras[i].video = video;
    sizes_fit &= check_size(camera, video, report);
    timing.push_back(timing_of(camera, video));
    if (scene_rate == 0) scene_rate = timing.back().rate;
    if (scene_rate == 0) {
      report.findings.push_back(
          {"", true, "no frame rate: the frames are images", "state frame_rate in the scene"});
      return false;
    }
    say_dropped(camera, video.missing, "images are missing, by the numbers in their names", report);
    check_steps_between_frames(camera, timing.back().steps, video.frame_count, report);
  }
  if (timing.size() < scene.cameras.size()) return false;
  if (!check_common_rate(scene, timing, report)) {
    for (size_t i = 0; i < timing.size(); ++i)
      check_rate(scene, scene.cameras[i], timing[i].rate, scene_rate, report);
  }
  check_lengths(scene, timing, scene_rate, report);
  return sizes_fit;
}

void check_decoding(const Scene& scene, const JobControl& control, CheckReport& report) {
  for (size_t i = 0; i < scene.cameras.size() && !control.stopping(); ++i) {
    control.progress("checking videos", i, scene.cameras.size());
    if (scene.cameras[i].video.empty()) continue;
    FrameSource source(scene.cameras[i].video);
    source.skip(kMostDecoded);
    if (source.trouble().empty()) continue;
    report.findings.push_back(
        {scene.cameras[i].name, true, source.trouble(), "copy or convert the file again"});
  }
}

}  // namespace jobs
}  // namespace walktrack
