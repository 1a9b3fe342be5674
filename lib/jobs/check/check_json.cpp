#include <nlohmann/json.hpp>

#include "core/conventions.h"
#include "jobs/check/check.h"

namespace walktrack {
inline namespace jobs {

namespace {

using Json = nlohmann::ordered_json;

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
