#include "jobs/check/check_report.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/conventions.h"

namespace walktrack {
inline namespace jobs {

namespace {

using Json = nlohmann::ordered_json;

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

Json camera_json(const CheckedCamera& camera) {
  const CameraInspection& view = camera.view;
  Json out = {{"name", camera.name},
              {"centre_m", {view.centre.x(), view.centre.y(), view.centre.z()}},
              {"tilt_deg", deg_from_rad(view.tilt)},
              {"roll_deg", deg_from_rad(view.roll)},
              {"view_deg", {deg_from_rad(view.horizontal_view), deg_from_rad(view.vertical_view)}},
              {"video",
               {{"size_px", {camera.video.width_px, camera.video.height_px}},
                {"frames", camera.video.frame_count},
                {"frame_rate_hz", camera.video.frame_rate}}}};
  if (view.standing_place) {
    out["person_seen_whole"] = {{"at_m", {view.standing_place->x(), view.standing_place->y()}},
                                {"height_px", view.person_px}};
  }
  return out;
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

std::string check_text(const CheckReport& report) {
  std::string text;
  for (const CheckedCamera& camera : report.cameras) text += camera_text(camera);
  for (const Finding& finding : report.findings) text += finding_text(finding);
  if (report.findings.empty()) text += "no mistakes were found\n";
  return text;
}

std::string check_json(const CheckReport& report) {
  Json root = {
      {"sound", !report.failed()}, {"cameras", Json::array()}, {"findings", Json::array()}};
  for (const CheckedCamera& camera : report.cameras) root["cameras"].push_back(camera_json(camera));
  for (const Finding& finding : report.findings) {
    root["findings"].push_back({{"failure", finding.failure},
                                {"camera", finding.camera},
                                {"what", finding.what},
                                {"cure", finding.cure}});
  }
  return root.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace jobs
}  // namespace walktrack
