#include "jobs/calibrate/import_calibration.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/errors.h"
#include "core/version.h"
#include "io/archive/files.h"
#include "io/archive/result_folder.h"
#include "io/calibration/formats/opencv.h"
#include "io/calibration/formats/toml.h"

namespace walktrack {
inline namespace jobs {

namespace {

constexpr const char* kOnlyName = "cam0";  // name of the camera in a file that does not name any

bool can_name_a_file(const std::string& name) {
  return !name.empty() && name.front() != '.' && name.size() <= 100 &&
         std::none_of(name.begin(), name.end(),
                      [](unsigned char c) { return c == '/' || c < ' '; });
}

std::vector<std::string> names_to_take(const ImportJob& job) {
  if (!job.name.empty()) return {job.name};
  std::vector<std::string> names = calibration_names(job.file);
  if (names.empty()) names.emplace_back(kOnlyName);
  for (auto at = names.begin(); at != names.end(); ++at) {
    if (!can_name_a_file(*at))
      throw InputError(describe({job.file.string(), 0, ""},
                                fmt::format("a camera called '{}'", *at),
                                "a name without /, of at most 100 characters, or --name"));
    if (std::find(names.begin(), at, *at) != at)
      throw InputError(describe({job.file.string(), 0, ""},
                                fmt::format("two cameras called '{}'", *at), "names of their own"));
  }
  return names;
}

// The common part of the names of all cameras' files.
std::string common_name(const std::vector<std::string>& names) {
  return names.size() == 1 ? names.front() : "cameras";
}

Outputs outputs_of(const ImportJob& job, const std::vector<std::string>& names) {
  const std::string common = common_name(names);
  Outputs out{job.output, "calibrate_" + common, {}, {job.file}, common + ".toml"};
  for (const std::string& name : names) out.files.push_back(name + ".yaml");
  out.files.push_back(common + "_run.json");
  out.files.push_back(out.last);
  return out;
}

// The axis, x, y or z with either sign, that points up in the images.
Eigen::Vector3d upright_axis(const std::vector<std::pair<std::string, Camera>>& cameras) {
  Eigen::Vector3d up = Eigen::Vector3d::Zero();
  for (const auto& [name, camera] : cameras) up -= camera.rotation.row(1);
  Eigen::Index axis = 0;
  up.cwiseAbs().maxCoeff(&axis);
  Eigen::Vector3d out = Eigen::Vector3d::Zero();
  out[axis] = up[axis] < 0 ? -1 : 1;
  return out;
}

// In scenes z points up and the floor is z = 0 unless the scene states something else.
std::vector<std::string> notes_about_axes(
    const std::vector<std::pair<std::string, Camera>>& cameras) {
  const Eigen::Vector3d up = upright_axis(cameras);
  if (up.z() != 1)
    return {
        fmt::format("the pictures stand upright along [{:g}, {:g}, {:g}] of these axes; write "
                    "into scene.yaml: ground: {{normal: [{:g}, {:g}, {:g}], offset: D}}, D the "
                    "floor's place along it, m (0 where it goes through the origin)",
                    up.x(), up.y(), up.z(), up.x(), up.y(), up.z())};
  std::vector<std::string> notes;
  for (const auto& [name, camera] : cameras)
    if (const double height = camera_centre(camera).z(); height < 0)
      notes.push_back(
          fmt::format("{} lies {:.3f} m below z = 0: where is the floor? In scene.yaml "
                      "ground: {{offset: D}} says so, m",
                      name, -height));
  return notes;
}

std::string run_text(const ImportJob& job, const ImportOutcome& outcome) {
  const BuildFacts& facts = build_facts();
  std::vector<std::string> names;
  for (const auto& [name, camera] : outcome.cameras) names.push_back(name);
  const nlohmann::ordered_json out{
      {"program", {{"name", "walktrack"}, {"version", facts.version}, {"commit", facts.commit}}},
      {"command", "calibrate"},
      {"command_line", job.command_line},
      {"cameras", names},
      {"notes", outcome.notes}};
  return out.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace

ImportOutcome import_calibration(const ImportJob& job) {
  const std::vector<std::string> names = names_to_take(job);
  const Outputs outputs = outputs_of(job, names);
  refuse_what_is_not_ours(outputs);
  refuse_existing(job.output / outputs.last, job.overwrite);
  ImportOutcome out;
  for (const std::string& name : names)
    out.cameras.emplace_back(name, read_calibration(job.file, name, job.size));
  out.notes = notes_about_axes(out.cameras);
  const ResultFolder folder(outputs, job.overwrite);
  for (const auto& [name, camera] : out.cameras)
    folder.write(name + ".yaml", opencv_from_camera(camera));
  folder.write(common_name(names) + "_run.json", run_text(job, out));
  folder.write(outputs.last, toml_from_cameras(out.cameras));
  return out;
}

std::string import_text(const ImportOutcome& outcome) {
  std::string out;
  for (const auto& [name, camera] : outcome.cameras) {
    const Eigen::Vector3d at = camera_centre(camera);
    out += fmt::format("{}: {}x{} px, focal length {:.1f} {:.1f} px, at {:.3f} {:.3f} {:.3f} m\n",
                       name, camera.width_px, camera.height_px, camera.focal_px.x(),
                       camera.focal_px.y(), at.x(), at.y(), at.z());
  }
  for (const std::string& note : outcome.notes) out += "note: " + note + "\n";
  return out;
}

}  // namespace jobs
}  // namespace walktrack
