#include "jobs/init/init.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/conventions.h"
#include "core/errors.h"
#include "core/version.h"
#include "io/archive/result_folder.h"
#include "io/calibration/formats/opencv.h"
#include "io/drawing/overlay.h"
#include "io/drawing/picture.h"
#include "io/tables/table_notes.h"
#include "io/video/video.h"
#include "jobs/init/init_files.h"
#include "jobs/init/lens_guess.h"
#include "jobs/init/seen_walker.h"
#include "observation/image.h"
#include "observation/image_threads.h"

namespace walktrack {
inline namespace jobs {

namespace fs = std::filesystem;

namespace {

constexpr const char* kCalibrationFile = "camera.yaml";

// Height of a walking subject in the image from floor to top, as a share of their height: the mean
// over a stride. Knees are bent; shoes and hair add height; the floor in the image is that at the
// nearer edge of the feet. Fitted on renders: 0.990 (two walks of one person by six cameras of an
// independent renderer) and 0.957 (three walks of this program's renderer); this is the mean, with
// half of the difference as spread.
constexpr double kSeenShare = 0.975, kSeenShareSd = 0.018;

// Spread of the tilt of cameras that people take for level.
constexpr double kTiltSd_deg = 3, kStatedTiltSd_deg = 0.3, kRollSd_deg = 1;

// The least distance that somebody has to walk to be the subject, in their heights.
constexpr double kLeastWay = 0.5;

ViewAssumptions assumptions(const InitJob& job, const SeenWalk& walk, const LensGuess& lens) {
  ViewAssumptions out;
  out.width_px = walk.width_px;
  out.height_px = walk.height_px;
  out.focal_px = lens.focal_px;
  out.focal_sd = lens.focal_sd;
  out.stature = kSeenShare * job.height;
  out.stature_sd = kSeenShareSd * job.height;
  out.tilt = rad_from_deg(job.tilt_deg.value_or(0));
  out.tilt_sd = rad_from_deg(job.tilt_deg ? kStatedTiltSd_deg : kTiltSd_deg);
  out.roll_sd = rad_from_deg(kRollSd_deg);
  out.floor = job.floor;
  return out;
}

// The positions of one walk; InputError if there is none.
std::vector<SeenStature> checked_positions(const InitJob& job, const SeenWalk& walk) {
  std::vector<SeenStature> out;
  for (const WalkerPosition& position : stride_positions(walk.figures, walk.looks_hz))
    out.push_back(position.seen);
  const auto trouble = [&](const std::string& found) {
    throw InputError(
        describe({job.video.string(), 0, ""}, found,
                 "a person who walks through the picture, seen from the side, with head and feet "
                 "visible for a second or more, and higher than a tenth of the picture"));
  };
  if (walk.figures.empty()) trouble("no person whose head and feet are visible");
  if (out.empty())
    trouble(fmt::format("a person whose head and feet are visible in only {} frames",
                        walk.figures.size()));
  const auto [left, right] =
      std::minmax_element(walk.figures.begin(), walk.figures.end(),
                          [](const SeenFigure& a, const SeenFigure& b) { return a.u_px < b.u_px; });
  const double size = out[out.size() / 2].bottom_px - out[out.size() / 2].top_px;
  if (right->u_px - left->u_px < kLeastWay * size)
    trouble("a person who stays in one place, or comes straight towards the camera");
  return out;
}

double distance_of(const Camera& camera, const SeenStature& seen) {
  const auto foot = ground_point(camera, {seen.u_px, seen.bottom_px});
  return foot ? (foot->head<2>() - camera_centre(camera).head<2>()).norm() : 0;
}

// The uncertainty of a share: two standard deviations, in per cent.
double percent(const Measured& of) { return 200 * of.sd / of.value; }

std::string scene_yaml(const InitJob& job, const InitOutcome& out) {
  std::string text = fmt::format(
      "# Made by walktrack init from a video and a height, without a calibration: init.json has "
      "the "
      "bands.\n"
      "# Speeds and steps across the picture are exact to {:.0f} %. Do not use the distance from\n"
      "# the camera, the step width, and everything that turns out of the picture.\n"
      "cameras:\n  - {{name: camera, video: {}, calibration: {}",
      percent(out.view.metres_per_px), path_beside(job.video, job.output), kCalibrationFile);
  if (!job.background.empty())
    text += fmt::format(", background: {}", path_beside(job.background, job.output));
  text += "}\n";
  if (job.frame_rate) text += fmt::format("frame_rate: {:g}\n", *job.frame_rate);
  return text + subject_line(job.height, job.mass);
}

std::string record_json(const InitJob& job, const InitOutcome& out, const SeenWalk& walk) {
  nlohmann::ordered_json root;
  root["format"] = "walktrack init 1";
  root["program"] = build_facts().version;
  root["command_line"] = job.command_line;
  root["subject_height_m"] = json_number(job.height);
  root["camera_height_m"] = measured_json(out.view.height);
  root["tilt_deg"] = measured_json(out.view.tilt, deg_from_rad(1));
  root["roll_deg"] = measured_json(out.view.roll, deg_from_rad(1));
  root["distance_m"] = measured_json(out.view.distance);
  root["metres_per_px"] = {{"value", out.view.metres_per_px.value},
                           {"sd", out.view.metres_per_px.sd}};
  root["fov_deg"] = measured_json({out.fov_deg, out.fov_sd_deg});
  root["fov_from"] = out.fov_from;
  root["rows_missed_percent"] = json_number(100 * out.view.residual);
  if (!job.floor.empty()) root["floor_lengths_missed_m"] = json_number(out.view.floor_rms);
  for (const WalkerPosition& position : stride_positions(walk.figures, walk.looks_hz))
    root["positions"].push_back({{"time_s", json_number(position.time)},
                                 {"u_px", json_number(position.seen.u_px)},
                                 {"top_px", json_number(position.seen.top_px)},
                                 {"bottom_px", json_number(position.seen.bottom_px)}});
  return root.dump(1) + "\n";
}

// Draws the ground, the horizon, and the subject at the estimated height at every position.
std::string picture_png(const InitJob& job, const InitOutcome& out,
                        std::span<const SeenStature> positions, int frame_number) {
  FrameSource source(job.video, PixelSize(out.view.camera.width_px, out.view.camera.height_px));
  Image frame;
  if (!source.skip(frame_number) || !source.read(frame))
    throw InputError(describe({job.video.string(), 0, ""}, source.trouble(), ""));
  const Camera& camera = out.view.camera;
  const int thick = line_thickness(frame);
  draw_ground_grid(frame, camera, {0, 0}, 6);
  draw_axes(frame, camera, Eigen::Vector3d::Zero(), 1);
  draw_line(frame, camera, {-300, 1000, camera_centre(camera).z()},
            {300, 1000, camera_centre(camera).z()}, {255, 255, 255}, thick);
  for (const SeenStature& seen : positions) {
    const auto foot = ground_point(camera, {seen.u_px, seen.bottom_px});
    if (!foot) continue;
    draw_line(frame, camera, *foot, *foot + Eigen::Vector3d(0, 0, kSeenShare * job.height),
              right_colour(), 2 * thick);
    for (const double row : {seen.top_px, seen.bottom_px})
      draw_stroke(frame, {seen.u_px - 6 * thick, row}, {seen.u_px + 6 * thick, row}, trunk_colour(),
                  thick);
  }
  for (const FloorLength& length : job.floor) {
    const auto from = ground_point(camera, length.from_px), to = ground_point(camera, length.to_px);
    if (from && to) draw_line(frame, camera, *from, *to, left_colour(), 2 * thick);
  }
  draw_caption(
      frame, fmt::format("camera {:.2f} m high, {:.1f} m away; lines are {:.2f} m; 1 m grid",
                         out.view.height.value, out.view.distance.value, kSeenShare * job.height));
  return png_bytes(frame);
}

Outputs outputs_of(const InitJob& job) {
  Outputs outputs{job.output,
                  "init",
                  {kInitScene, kCalibrationFile, kInitPicture, kInitRecord},
                  {job.video},
                  kInitRecord};
  if (!job.background.empty()) outputs.inputs.push_back(job.background);
  return outputs;
}

}  // namespace

InitOutcome init_scene(const InitJob& job, const JobControl& control) {
  refuse_what_is_not_ours(outputs_of(job));
  // Results of the pose network depend on the number of OpenCV's threads.
  set_image_threads(1);
  const SeenWalk walk = seen_walk(job, control);
  const std::vector<SeenStature> positions = checked_positions(job, walk);
  const double side_px = std::max(walk.width_px, walk.height_px);
  const LensGuess lens = lens_guess(job.video, side_px, job.fov_deg);
  InitOutcome out;
  out.view = view_from_walker(positions, assumptions(job, walk, lens));
  const Measured& focal = out.view.focal_px;
  out.fov_deg = fov_deg_of(side_px, focal.value);
  out.fov_sd_deg = std::abs(fov_deg_of(side_px, focal.value + focal.sd) - out.fov_deg);
  out.fov_from = lens.from;
  out.positions = positions.size();
  out.nearest = out.farthest = out.view.distance.value;
  for (const SeenStature& seen : positions) {
    out.nearest = std::min(out.nearest, distance_of(out.view.camera, seen));
    out.farthest = std::max(out.farthest, distance_of(out.view.camera, seen));
  }
  const ResultFolder folder(outputs_of(job), job.overwrite);
  folder.write(kCalibrationFile, opencv_from_camera(out.view.camera));
  folder.write(kInitPicture,
               picture_png(job, out, positions, walk.figures[walk.figures.size() / 2].frame));
  folder.write(kInitScene, scene_yaml(job, out));
  out.scene = folder.file(kInitScene);
  out.picture = folder.file(kInitPicture);
  folder.write(kInitRecord, record_json(job, out, walk));
  out.check = check_scene({out.scene, {}}, control);
  return out;
}

std::string init_text(const InitOutcome& out) {
  const WalkerView& view = out.view;
  std::string text = fmt::format(
      "  scale          {:.2f} mm a pixel where the subject walks, ± {:.0f} %\n"
      "  camera         {} m above the floor, looking down {}°, turned {}°\n"
      "  distance       {:.1f} to {:.1f} m, ± {:.0f} %\n"
      "  field of view  {:.0f} (± {:.0f})° along the longer side, {}\n"
      "  seen at        {} of the walk; the rows have errors of {:.1f} % of the height{}\n"
      "Use it for speed, cadence, step length and time, and angles in the plane of the picture; "
      "lengths are exact to ± {:.0f} %.\n"
      "Do not use it for the distance from the camera, step width, and anything else across the "
      "walk; heights above the floor are rough.\n"
      "Bands are two standard deviations. The result is better with --fov-deg of your lens, "
      "--tilt-deg measured with a spirit level,\n"
      "--floor of a tile, a second camera, or 'walktrack calibrate'.\n"
      "Look at {}: do the lines end at feet and head, and does the grid lie on the floor?\n",
      1000 * view.metres_per_px.value, percent(view.metres_per_px), band(view.height, 1, 2),
      band(view.tilt, deg_from_rad(1), 1), band(view.roll, deg_from_rad(1), 1), out.nearest,
      out.farthest, percent(view.distance), out.fov_deg, 2 * out.fov_sd_deg, out.fov_from,
      out.positions == 1 ? "one place" : fmt::format("{} places", out.positions),
      100 * view.residual,
      view.floor_rms > 0 ? fmt::format(", the lengths on the floor of {:.3f} m", view.floor_rms)
                         : "",
      percent(view.metres_per_px), out.picture.string());
  return text + check_text(out.check);
}

}  // namespace jobs
}  // namespace walktrack
