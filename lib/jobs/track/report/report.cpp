#include "jobs/track/report/report.h"

#include <cmath>

#include <nlohmann/json.hpp>

#include "io/archive/files.h"
#include "io/tables/motion_file.h"
#include "jobs/track/report/report_curves.h"

namespace walktrack {
inline namespace jobs {

namespace {

using Json = nlohmann::ordered_json;

constexpr size_t kMaxTableBytes = size_t{1} << 28;

Json millimetres(double metres) {
  return std::isfinite(metres) ? Json(std::lround(1000 * metres)) : Json();
}

// Rounded to thousandths, because the page only shows the numbers.
Json rounded(double value) {
  return std::isfinite(value) ? Json(std::round(1000 * value) / 1000) : Json();
}

Json triple(const Eigen::Vector3d& p) { return {rounded(p.x()), rounded(p.y()), rounded(p.z())}; }

// The position of the camera and the corners of its image, one metre in front of it.
Json camera_json(const SceneCamera& scene_camera) {
  const Camera& camera = scene_camera.camera;
  Json corners = Json::array();
  for (const auto& [u, v] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
    const auto ray = unproject(camera, {u * (camera.width_px - 1.0), v * (camera.height_px - 1.0)});
    corners.push_back(ray ? triple(ray->origin + ray->direction) : Json());
  }
  return {{"name", scene_camera.name},
          {"size_px", {camera.width_px, camera.height_px}},
          {"centre", triple(camera_centre(camera))},
          {"corners", corners}};
}

// A frame's joints in one list x, y, z, x, ... in mm; null if unknown.
Json frame_row(const JointPositions& joints, size_t count) {
  Json row = Json::array();
  bool any = false;
  for (size_t j = 0; j < count; ++j) {
    any = any || known(joints.at[j]);
    for (const double value : joints.at[j]) row.push_back(millimetres(value));
  }
  return any ? row : Json();
}

Json motion_json(const Motion& motion, const JointUncertainty& uncertainty) {
  const auto count = static_cast<size_t>(listed_joint_count(motion));
  const auto rows = [&](const std::vector<JointPositions>& frames) {
    Json out = Json::array();
    for (const JointPositions& joints : frames) out.push_back(frame_row(joints, count));
    return out;
  };
  return {{"names", kJointNames},
          {"mean_mm", rows(motion.joints)},
          {"p05_mm", rows(uncertainty.p05)},
          {"p95_mm", rows(uncertainty.p95)}};
}

Json times_json(const std::vector<double>& times) {
  Json out = Json::array();
  for (const double time : times) out.push_back(std::round(1e6 * time) / 1e6);
  return out;
}

Json contacts_json(const Gait& gait) {
  Json out = Json::array();
  for (const Stance& stance : gait.stances) {
    out.push_back({{"side", stance.side == Side::kLeft ? "left" : "right"},
                   {"on", rounded(stance.on)},
                   {"off", rounded(stance.off)},
                   {"x", rounded(stance.place.x())},
                   {"y", rounded(stance.place.y())}});
  }
  return out;
}

}  // namespace

std::filesystem::path write_report(const ResultFolder& folder, const ReportInput& input) {
  const AnalysedMotion& analysed = input.analysed;
  const Gait gait = gait_from_motion(analysed.motion);
  Json cameras = Json::array();
  for (const SceneCamera& camera : input.cameras) cameras.push_back(camera_json(camera));
  Json data;
  data["run"] = Json::parse(input.run_json);
  data["gait"] = Json::parse(read_text_file(folder.file("gait.json"), kMaxTableBytes));
  data["subject"] = {{"height_m", rounded(analysed.subject.height)},
                     {"mass_kg", rounded(analysed.subject.mass)}};
  data["rate"] = analysed.rate;
  data["times"] = times_json(analysed.motion.time);
  data["cameras"] = cameras;
  data["joints"] = motion_json(analysed.motion, input.uncertainty);
  data["contacts"] = contacts_json(gait);
  data["angles"] = cycles_json(angle_signals(folder.path()), gait);
  data["more_angles"] = cycles_json(more_angle_signals(folder.path()), gait);
  data["loads"] = cycles_json(load_signals(folder, analysed), gait);
  data["normal_csv"] = normal_gait_csv();
  ReportPage page;
  const std::filesystem::path source = std::filesystem::absolute(input.source);
  page.title = source.parent_path().filename().string() + " / " + source.filename().string();
  data["title"] = page.title;
  page.data_json = data.dump(-1, ' ', false, Json::error_handler_t::replace);
  page.clips = input.clips;
  write_report_page(folder.file(kReportFile), page);
  return folder.file(kReportFile);
}

}  // namespace jobs
}  // namespace walktrack
