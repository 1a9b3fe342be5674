#include "jobs/init/init_pair.h"

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
#include "jobs/init/seen_person.h"
#include "observation/image.h"
#include "observation/image_threads.h"

namespace walktrack {
inline namespace jobs {

namespace fs = std::filesystem;

namespace {

constexpr std::array kNames{"first", "second"};
// Spread of a height that is stated by a person.
constexpr double kStatureSd_m = 0.01;
// The grid reaches this far from the middle of the walk; the subject is drawn at so many places.
constexpr double kGrid_m = 4;
constexpr size_t kPoles = 6;
// The least distance that the subject has to walk on the floor, in their heights: rays at one place
// do not determine the cameras.
constexpr double kLeastPairWay = 0.5;

std::string calibration_file(size_t camera) { return fmt::format("{}.yaml", kNames[camera]); }

TwoViewAssumptions assumptions(const InitPairJob& job, const std::array<SeenPerson, 2>& seen,
                               const std::array<LensGuess, 2>& lenses) {
  TwoViewAssumptions out{{}, job.height, kStatureSd_m};
  for (size_t c = 0; c < 2; ++c)
    out.lenses[c] = {seen[c].width_px, seen[c].height_px, lenses[c].focal_px, lenses[c].focal_sd};
  return out;
}

void check_way(const InitPairJob& job, const std::vector<Eigen::Vector3d>& places) {
  double way = 0;
  for (const Eigen::Vector3d& place : places) way = std::max(way, (place - places.front()).norm());
  if (way < kLeastPairWay * job.height)
    throw InputError(describe({job.videos[0].string(), 0, ""}, "a person who stays in one place",
                              "a person who walks through both videos at the same time"));
}

// Removes the lag, to the nearest frame, if it is more than two standard deviations.
void take_out_lag(InitPairOutcome& out, double frame_rate) {
  const Measured& lag = out.views.lag;
  if (std::abs(lag.value) < 2 * lag.sd) return;
  out.early = lag.value > 0 ? 1 : 0;
  out.start_frame = static_cast<int>(std::lround(std::abs(lag.value) * frame_rate));
}

std::string scene_yaml(const InitPairJob& job, const InitPairOutcome& out) {
  std::string text = fmt::format(
      "# Made by walktrack init of two videos and a height, without a calibration: init.json has "
      "the bands.\n# Lengths are exact to {:.0f} %.\ncameras:\n",
      200 * out.views.apart.sd / out.views.apart.value);
  for (size_t c = 0; c < 2; ++c) {
    text += fmt::format("  - {{name: {}, video: {}, calibration: {}", kNames[c],
                        path_beside(job.videos[c], job.output), calibration_file(c));
    if (!job.backgrounds.empty())
      text += fmt::format(", background: {}", path_beside(job.backgrounds[c], job.output));
    if (out.start_frame > 0)
      text += fmt::format(", start_frame: {}", c == out.early ? out.start_frame : 0);
    text += "}\n";
  }
  if (job.frame_rate) text += fmt::format("frame_rate: {:g}\n", *job.frame_rate);
  return text + subject_line(job.height, job.mass);
}

std::string record_json(const InitPairJob& job, const InitPairOutcome& out) {
  const TwoViews& views = out.views;
  nlohmann::ordered_json root;
  root["format"] = "walktrack init of two 1";
  root["program"] = build_facts().version;
  root["command_line"] = job.command_line;
  root["subject_height_m"] = json_number(job.height);
  root["apart_m"] = measured_json(views.apart);
  root["angle_deg"] = measured_json(views.angle, deg_from_rad(1));
  root["lag_s"] = measured_json(views.lag);
  root["points_missed_percent"] = json_number(100 * views.residual);
  root["moments"] = out.moments;
  for (size_t c = 0; c < 2; ++c)
    root["cameras"].push_back({{"name", kNames[c]},
                               {"height_m", measured_json(views.height[c])},
                               {"tilt_deg", measured_json(views.tilt[c], deg_from_rad(1))},
                               {"distance_m", measured_json(views.distance[c])},
                               {"fov_deg", measured_json(out.fov_deg[c])},
                               {"fov_from", out.fov_from[c]}});
  return root.dump(1) + "\n";
}

// The image of one camera with the grid, and the subject at the estimated height.
Image view_of(const InitPairJob& job, const InitPairOutcome& out, size_t c, int frame_number) {
  const Camera& camera = out.views.cameras[c];
  FrameSource source(job.videos[c], PixelSize(camera.width_px, camera.height_px));
  Image frame;
  if (!source.skip(frame_number) || !source.read(frame))
    throw InputError(describe({job.videos[c].string(), 0, ""}, source.trouble(), ""));
  draw_ground_grid(frame, camera, {0, 0}, kGrid_m);
  draw_axes(frame, camera, Eigen::Vector3d::Zero(), 1);
  const size_t every = std::max<size_t>(1, out.views.places.size() / kPoles);
  for (size_t k = 0; k < out.views.places.size(); k += every)
    draw_line(frame, camera, out.views.places[k],
              out.views.places[k] + Eigen::Vector3d(0, 0, job.height), right_colour(),
              2 * line_thickness(frame));
  draw_caption(frame, fmt::format("{}, {:.2f} m high", kNames[c], out.views.height[c].value));
  return frame;
}

std::string picture_png(const InitPairJob& job, const InitPairOutcome& out,
                        const std::array<int, 2>& frames) {
  return png_bytes(beside(view_of(job, out, 0, frames[0]), view_of(job, out, 1, frames[1])));
}

Outputs outputs_of(const InitPairJob& job) {
  Outputs outputs{job.output,
                  "init",
                  {kInitScene, calibration_file(0), calibration_file(1), kInitPicture, kInitRecord},
                  {job.videos[0], job.videos[1]},
                  kInitRecord};
  for (const fs::path& background : job.backgrounds) outputs.inputs.push_back(background);
  return outputs;
}

std::string lag_text(const InitPairOutcome& out) {
  if (out.start_frame == 0) return "none that can be seen";
  return fmt::format("{} began {:.2f} s (± {:.2f}) before {}, which the scene corrects",
                     kNames[out.early], std::abs(out.views.lag.value), 2 * out.views.lag.sd,
                     kNames[1 - out.early]);
}

// States what the pair of cameras can be used for.
std::string use_text(const TwoViews& views) {
  constexpr double kUseful_percent = 20;  // uncertainty of the cameras' distance; by hand
  const double percent = 200 * views.apart.sd / views.apart.value;
  if (percent > kUseful_percent)
    return fmt::format(
        "Use it for cadence, for comparing left and right, and roughly for angles. Do not use it "
        "for lengths (± {:.0f} %) unless you state the lenses.\n",
        percent);
  return fmt::format(
      "Use it for steps, speeds, angles and step width; lengths are exact to ± {:.0f} %. A wrong "
      "height makes all lengths wrong in the same proportion.\n",
      percent);
}

}  // namespace

InitPairOutcome init_pair(const InitPairJob& job, const JobControl& control) {
  refuse_what_is_not_ours(outputs_of(job));
  if (std::error_code none; std::filesystem::equivalent(job.videos[0], job.videos[1], none))
    throw UsageError(describe({job.videos[1].string(), 0, ""}, "the same video twice",
                              "the videos of two cameras"));
  // Results of the pose network depend on the number of OpenCV's threads.
  set_image_threads(1);
  const std::array<SeenPerson, 2> seen{seen_person(job.videos[0], job.frame_rate, control),
                                       seen_person(job.videos[1], job.frame_rate, control)};
  std::array<LensGuess, 2> lenses;
  std::array<double, 2> side_px;
  for (size_t c = 0; c < 2; ++c) {
    side_px[c] = std::max(seen[c].width_px, seen[c].height_px);
    lenses[c] = lens_guess(job.videos[c], side_px[c], job.fov_deg[c]);
  }
  InitPairOutcome out;
  out.views = two_views(seen[0].moments, seen[1].moments, assumptions(job, seen, lenses));
  check_way(job, out.views.places);
  out.moments = out.views.places.size();
  for (size_t c = 0; c < 2; ++c) {
    const Measured& focal = out.views.focal_px[c];
    const double fov = fov_deg_of(side_px[c], focal.value);
    out.fov_deg[c] = {fov, std::abs(fov_deg_of(side_px[c], focal.value + focal.sd) - fov)};
    out.fov_from[c] = lenses[c].from;
  }
  take_out_lag(out, seen[0].frame_rate);
  const ResultFolder folder(outputs_of(job), job.overwrite);
  for (size_t c = 0; c < 2; ++c)
    folder.write(calibration_file(c), opencv_from_camera(out.views.cameras[c]));
  folder.write(kInitPicture, picture_png(job, out,
                                         {seen[0].frames[seen[0].frames.size() / 2],
                                          seen[1].frames[seen[1].frames.size() / 2]}));
  folder.write(kInitScene, scene_yaml(job, out));
  out.scene = folder.file(kInitScene);
  out.picture = folder.file(kInitPicture);
  folder.write(kInitRecord, record_json(job, out));
  out.check = check_scene({out.scene, {}}, control);
  return out;
}

std::string init_pair_text(const InitPairOutcome& out) {
  const TwoViews& views = out.views;
  std::string text = fmt::format("  cameras        {} m apart, turned by {}° to each other\n",
                                 band(views.apart, 1, 2), band(views.angle, deg_from_rad(1), 1));
  for (size_t c = 0; c < 2; ++c)
    text += fmt::format(
        "  {:<13}  {} m above the floor, looking down {}°, {} m from the middle of the walk;\n"
        "                 field of view {}° along the longer side (first guess: {})\n",
        kNames[c], band(views.height[c], 1, 2), band(views.tilt[c], deg_from_rad(1), 1),
        band(views.distance[c], 1, 1), band(out.fov_deg[c], 1, 0), out.fov_from[c]);
  text += fmt::format(
      "  lag            {}\n"
      "  seen at        {} moments by both; the points have errors of {:.1f} % of the height\n"
      "{}"
      "Bands are two standard deviations. The result is better with --fov-deg of your lenses, or "
      "with 'walktrack calibrate'.\n"
      "Look at {}: does the grid lie on the floor, and do the lines stand where the subject "
      "walked, as high as the subject?\n",
      lag_text(out), out.moments, 100 * views.residual, use_text(views), out.picture.string());
  return text + check_text(out.check);
}

}  // namespace jobs
}  // namespace walktrack
