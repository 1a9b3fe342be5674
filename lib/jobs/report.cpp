#include "jobs/report.h"

#include <cmath>

#include <nlohmann/json.hpp>

#include "io/files.h"
#include "jobs/report_curves.h"

namespace walktrack {

namespace {

using Json = nlohmann::ordered_json;

constexpr size_t kMaxTableBytes = size_t{1} << 28;

Json millimetres(double metres) {
  return std::isfinite(metres) ? Json(std::lround(1000 * metres)) : Json();
}

// To a thousandth: pages are read, not computed with.
Json rounded(double value) {
  return std::isfinite(value) ? Json(std::round(1000 * value) / 1000) : Json();
}

Json triple(const Eigen::Vector3d& p) { return {rounded(p.x()), rounded(p.y()), rounded(p.z())}; }

// Where the camera stands and the corners of its picture, one metre ahead of it.
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

// All joints of a frame in one list x, y, z, x, ...: mm.
template <typename Value>
Json frame_row(const FrameRecord& record, Value value) {
  if (!record.tracked) return {};
  Json row = Json::array();
  for (size_t j = 0; j < record.estimate.joint_count; ++j) {
    for (Eigen::Index axis = 0; axis < 3; ++axis) row.push_back(millimetres(value(j, axis)));
  }
  return row;
}

Json motion_json(const TrackedFrames& frames) {
  Json mean = Json::array(), low = Json::array(), high = Json::array();
  for (const FrameRecord& record : frames.records) {
    const FrameEstimate& e = record.estimate;
    const auto spread = [&](size_t j, Eigen::Index a) -> const Spread& {
      return e.spread[j][static_cast<size_t>(a)];
    };
    mean.push_back(frame_row(record, [&](size_t j, Eigen::Index a) { return e.joints.at[j][a]; }));
    low.push_back(frame_row(record, [&](size_t j, Eigen::Index a) { return spread(j, a).p05; }));
    high.push_back(frame_row(record, [&](size_t j, Eigen::Index a) { return spread(j, a).p95; }));
  }
  return {{"names", kJointNames}, {"mean_mm", mean}, {"p05_mm", low}, {"p95_mm", high}};
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
  const Motion motion = motion_of(input.frames);
  const Gait gait = gait_from_motion(motion);
  Json cameras = Json::array();
  for (const SceneCamera& camera : input.scene.cameras) cameras.push_back(camera_json(camera));
  Json data;
  data["run"] = Json::parse(input.run_json);
  data["gait"] = Json::parse(read_text_file(folder.file("gait.json"), kMaxTableBytes));
  data["subject"] = {{"height_m", input.scene.subject.height},
                     {"mass_kg", input.scene.subject.mass}};
  data["rate"] = input.frames.frame_rate;
  data["cameras"] = cameras;
  data["joints"] = motion_json(input.frames);
  data["contacts"] = contacts_json(gait);
  data["angles"] = cycles_json(angle_signals(folder), gait);
  data["loads"] = cycles_json(load_signals(folder, input.scene), gait);
  data["normal_csv"] = normal_gait_csv();
  ReportPage page;
  page.title = input.scene.file.parent_path().filename().string() + " / " +
               input.scene.file.filename().string();
  data["title"] = page.title;
  page.data_json = data.dump(-1, ' ', false, Json::error_handler_t::replace);
  page.clips = input.clips;
  write_report_page(folder.file("report.html"), page);
  return folder.file("report.html");
}

}  // namespace walktrack
