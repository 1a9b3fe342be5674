#include "jobs/check/check_sync.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "io/video/scene_video.h"
#include "observation/image.h"
#include "observation/two_views/out_of_step.h"
#include "observation/two_views/pair_lag.h"

namespace walktrack {
inline namespace jobs {

namespace {

// Limit between a failure and a remark, m. Rays of correctly calibrated cameras miss each other by
// up to 22 mm (rendered walks with three cameras), because shadows and clothes look different from
// different sides.
constexpr double kSureGap = 0.05;
// Agreement of the outlines' ends from which on lost frames are a failure. Below it the ends of one
// camera may be others than those of the other one, as those of a shadow, from some frame on.
// Chosen on pairs of cameras of made walks and of renders by another program, with and without lost
// frames: one of 66 pairs without has a change, with an agreement of .73.
constexpr double kSureLoss = 0.8;
constexpr double kBeforeLoss = 0.3;  // s by which the time of lost frames may be estimated too late
// As many frames as a step takes:
constexpr const char* kOrStandsElsewhere =
    ", if that is so; a camera that stands a step's length further along the way than its "
    "calibration says looks the same";

// The advice for a camera that began so many frames early, or for the other one, which began late.
std::string start_cure(const Scene& scene, int lag) {
  const bool second = scene.cameras[1].start_frame + lag >= 0;
  const SceneCamera& camera = scene.cameras[second ? 1 : 0];
  return fmt::format("set start_frame: {} for {}", camera.start_frame + (second ? lag : -lag),
                     camera.name);
}

void say_lost(const Scene& scene, const PairLag& lag, double frame_rate, CheckReport& report) {
  const int change = lag.after - lag.before;
  // The camera that lost frames shows everything earlier from then on.
  const SceneCamera& camera = scene.cameras[change < 0 ? 1 : 0];
  const SceneCamera& other = scene.cameras[change < 0 ? 0 : 1];
  const bool sure = lag.agreement >= kSureLoss;
  const int near = scene.first_frame + lag.changes_at;
  const int safe = near - static_cast<int>(std::lround(kBeforeLoss * frame_rate));
  // Inserted before the finding of unequal lengths, which follows from it.
  report.findings.insert(
      report.findings.begin(),
      {camera.name, sure,
       fmt::format("about {} frames {} missing near frame {}: from there on it {} ahead of {}",
                   std::abs(change), sure ? "are" : "may be", near, sure ? "is" : "seems",
                   other.name),
       fmt::format("restore the file's time stamps, or convert it to images whose numbers leave "
                   "the lost frames out; last_frame: {} tracks only the part before them",
                   safe)});
}

void say_pair_lag(const Scene& scene, const std::optional<PairLag>& lag, double frame_rate,
                  CheckReport& report) {
  if (!lag) {
    report.findings.push_back({"", false,
                               "the videos do not show whether the cameras are synchronous",
                               "a person has to walk through both pictures"});
    return;
  }
  if (lag->before != lag->after) return say_lost(scene, *lag, frame_rate, report);
  if (lag->after == 0) return;
  const size_t late_camera = lag->after > 0 ? 1 : 0;
  const SceneCamera& late = scene.cameras[late_camera];
  if (starts_are_open(scene) && !lag->may_be_steps) {
    for (Finding& finding : report.findings)
      finding.failure = finding.failure && !finding.may_be_lag;
    report.lag = FoundLag{late_camera, std::abs(lag->after), lag->sd};
    report.findings.push_back(
        {"", false,
         fmt::format("{} shows things {} frames later than the other (standard deviation {:.1f}), "
                     "found from the walk",
                     late.name, report.lag->frames, lag->sd),
         fmt::format("none needed, `track` puts the cameras in step; {} states it",
                     start_cure(scene, lag->after))});
    return;
  }
  report.findings.insert(
      report.findings.begin(),
      {"", true,
       fmt::format("the cameras are out of step: {} shows things {} frames "
                   "later than the other",
                   late.name, std::abs(lag->after)),
       start_cure(scene, lag->after) + (lag->may_be_steps ? kOrStandsElsewhere : "")});
}

}  // namespace

bool starts_are_open(const Scene& scene) {
  return scene.cameras.size() == 2 &&
         std::none_of(scene.cameras.begin(), scene.cameras.end(),
                      [](const SceneCamera& camera) { return camera.start_given; });
}

SeenFigures figures_in(const Scene& scene, const JobControl& control) {
  SceneVideo video(scene);
  SeenFigures out{video.frame_rate(), {}};
  std::vector<MovingFigures> cameras;
  for (const SceneCamera& each : scene.cameras)
    cameras.emplace_back(each.camera.width_px, each.camera.height_px);
  SceneFrames frames;
  for (int n = 0; n < kMostSyncFrames && !control.stopping() && video.read(frames); ++n)
    for (size_t i = 0; i < cameras.size(); ++i) {
      Image picture;
      if (frames.fresh[i]) video.source(i).picture(cameras[i].shrink(), picture);
      cameras[i].add(picture);
    }
  for (const MovingFigures& camera : cameras) out.paths.push_back(camera.path());
  return out;
}

void check_steps(const Scene& scene, const JobControl& control, CheckReport& report) {
  if (scene.cameras.size() < 2) return;
  std::vector<Camera> cameras;
  for (const SceneCamera& camera : scene.cameras) {
    if (camera.video.empty()) return;
    cameras.push_back(camera.camera);
    // A lag is measured in frames.
    if (!camera.frame_rate || camera.frame_rate == scene.frame_rate) continue;
    report.findings.push_back({"", false, "whether the cameras are synchronous is not checked",
                               "the cameras need the same frame rate"});
    return;
  }
  const SeenFigures seen = figures_in(scene, control);
  if (control.stopping()) return;
  if (scene.cameras.size() == 2)
    return say_pair_lag(scene, find_pair_lag(cameras, seen.paths, seen.frame_rate), seen.frame_rate,
                        report);
  const std::vector<OutOfStep> found = find_out_of_step(cameras, seen.paths);
  if (found.empty()) return;
  const bool sure = found.front().gap_before > kSureGap;
  std::string cure;
  for (const OutOfStep& late : found) {
    const SceneCamera& camera = scene.cameras[late.camera];
    cure += fmt::format("{}start_frame: {} for {} ({:.0f} mm then)", cure.empty() ? "" : ", or ",
                        camera.start_frame + late.frames_late, camera.name, 1000 * late.gap_after);
  }
  report.findings.push_back(
      {"", sure,
       fmt::format("the cameras {} out of step: planes through the figure miss each other by "
                   "{:.0f} mm",
                   sure ? "are" : "may be", 1000 * found.front().gap_before),
       cure + "; a negative number means to raise that of all others instead"});
}

}  // namespace jobs
}  // namespace walktrack
