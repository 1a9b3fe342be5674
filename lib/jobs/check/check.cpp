#include "jobs/check/check.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/conventions.h"
#include "jobs/check/check_parts.h"

namespace walktrack {
inline namespace jobs {

namespace {

std::string place_text(const CameraInspection& view) {
  if (!view.standing_place) return "sees no place where a person would be seen whole";
  const Eigen::Vector2d& place = *view.standing_place;
  return fmt::format("a person is seen whole e.g. at ({:.1f}, {:.1f}), {:.0f} px high", place.x(),
                     place.y(), view.person_px);
}

std::string ground_text(const CameraInspection& view) {
  if (view.footprint.empty()) return "sees no ground";
  double nearest = kFarthestGround, farthest = 0;
  for (const Eigen::Vector2d& point : view.footprint) {
    const double distance = (point - view.centre.head<2>()).norm();
    nearest = std::min(nearest, distance);
    farthest = std::max(farthest, distance);
  }
  return fmt::format("sees the ground from {:.1f} m to {}", nearest,
                     farthest > 0.95 * kFarthestGround ? std::string("the horizon")
                                                       : fmt::format("{:.1f} m", farthest));
}

std::string camera_text(const CheckedCamera& camera) {
  const CameraInspection& view = camera.view;
  const VideoFacts& video = camera.video;
  std::string text = fmt::format(
      "{}\n  stands at ({:.2f}, {:.2f}), {:.2f} m above the ground\n"
      "  looks {:.1f} degrees {} the horizon, rolled by {:.1f} degrees\n"
      "  view {:.0f} x {:.0f} degrees; {}\n  {}\n",
      camera.name, view.centre.x(), view.centre.y(), view.centre.z(),
      std::abs(deg_from_rad(view.tilt)), view.tilt < 0 ? "above" : "below", deg_from_rad(view.roll),
      deg_from_rad(view.horizontal_view), deg_from_rad(view.vertical_view), ground_text(view),
      place_text(view));
  text += fmt::format("  video {}x{} px, {} frames", video.width_px, video.height_px,
                      video.frame_count);
  return text + (video.frame_rate > 0 ? fmt::format(" at {:g} Hz\n", video.frame_rate) : "\n");
}

std::string finding_text(const Finding& finding) {
  return fmt::format("{}: {}{}\n{}", finding.failure ? "FAIL" : "note",
                     finding.camera.empty() ? "" : finding.camera + ": ", finding.what,
                     finding.cure.empty() ? "" : fmt::format("      cure: {}\n", finding.cure));
}

}  // namespace

bool CheckReport::failed() const {
  return std::any_of(findings.begin(), findings.end(),
                     [](const Finding& finding) { return finding.failure; });
}

std::string finding_line(const Finding& finding) {
  return fmt::format("{}{}{}", finding.camera.empty() ? "" : finding.camera + ": ", finding.what,
                     finding.cure.empty() ? "" : "; cure: " + finding.cure);
}

CheckReport look_at_scene(const Scene& scene, const JobControl& control) {
  CheckReport report;
  for (const SceneCamera& camera : scene.cameras) {
    report.cameras.push_back(
        {camera.name, inspect_camera(camera.camera, scene.subject.height), {}});
  }
  check_poses(scene, report);
  const bool poses_can_be = !report.failed();
  // Tests on the images mean nothing if calibrations or sizes are wrong.
  if (check_videos(scene, control, report) && poses_can_be) check_steps(scene, control, report);
  check_keypoints(scene, report);
  return report;
}

CheckReport check_scene(const CheckJob& job, const JobControl& control) {
  const Scene scene = read_scene(job.scene);
  if (!job.pictures.empty()) refuse_what_is_not_ours(check_outputs(scene, job.pictures));
  CheckReport report = look_at_scene(scene, control);
  check_decoding(scene, control, report);
  if (!scene.height_given)
    report.findings.push_back(
        {"", false,
         fmt::format("the scene does not say how tall the subject is: here {:g} m, in `track` what "
                     "the images say",
                     scene.subject.height),
         "where the height is known, subject: {height: METRES}"});
  if (!job.pictures.empty()) write_check_pictures(scene, report, job.pictures);
  return report;
}

std::string check_text(const CheckReport& report) {
  std::string text;
  for (const CheckedCamera& camera : report.cameras) text += camera_text(camera);
  for (const Finding& finding : report.findings) text += finding_text(finding);
  if (report.findings.empty()) text += "no mistakes were found\n";
  return text;
}

}  // namespace jobs
}  // namespace walktrack
