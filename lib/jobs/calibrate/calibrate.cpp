#include "jobs/calibrate/calibrate.h"

#include <cmath>
#include <map>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "camera/inspection.h"
#include "core/conventions.h"
#include "core/errors.h"
#include "core/version.h"
#include "io/archive/files.h"
#include "io/archive/result_folder.h"
#include "io/calibration/calibration.h"
#include "io/calibration/formats/opencv.h"
#include "io/calibration/formats/toml.h"
#include "io/drawing/picture.h"
#include "io/video/video.h"
#include "jobs/calibrate/calibrate_pictures.h"
#include "jobs/calibrate/calibrate_place.h"
#include "jobs/calibrate/calibrate_views.h"
#include "observation/image.h"

namespace walktrack {
inline namespace jobs {

namespace {

namespace fs = std::filesystem;

constexpr double kFocalKnown =
    0.02;  // relative deviation of the focal length below which the views determine it
const double kLeastApart = rad_from_deg(15);  // between boards; views that differ less do not
                                              // determine the focal length
constexpr double kUsualLensRms = 1;           // px; a larger error is due to a bent board, blur or
                                              // the wrong model

void require(const CalibrateJob& job) {
  if (job.views.empty() == job.camera.empty())
    throw UsageError("say where the lens comes from: --views VIDEO, or --camera FILE");
  if (!job.camera.empty() && job.floor.empty() && job.points.empty())
    throw UsageError("nothing to do: --camera has a lens; --floor or --points give its place");
  const bool floor_board = !job.floor.empty() && job.points.empty();
  if (!job.board && (!job.views.empty() || floor_board))
    throw UsageError("--views and a board on the --floor need --board, --size and --spacing");
}

// Endings of the file names.
constexpr const char *kCalibration = ".yaml", *kToml = ".toml", *kResiduals = "_residuals.csv",
                     *kLensPicture = "_lens.png", *kPlacePicture = "_place.png",
                     *kRun = "_run.json";

// Every camera has its own marker, because several are calibrated into one folder.
Outputs outputs_of(const CalibrateJob& job) {
  Outputs out{job.output,
              "calibrate_" + job.name,
              {},
              {job.views, job.camera, job.floor, job.points},
              job.name + kCalibration};
  for (const char* end : {kCalibration, kToml, kResiduals, kLensPicture, kPlacePicture, kRun})
    out.files.push_back(job.name + end);
  return out;
}

// By the endings of their file names; they are written after everything has succeeded.
using Pictures = std::map<std::string, Image>;

void add_residuals(const std::string& of, int frame, const PixelPoints& found,
                   const PixelPoints& misses, CalibrateOutcome& out) {
  for (size_t i = 0; i < found.size(); ++i)
    out.residuals.push_back({of, frame, static_cast<int>(i), found[i], misses[i]});
}

void find_lens(const CalibrateJob& job, const JobControl& control, CalibrateOutcome& out,
               Pictures& pictures) {
  const BoardViews views = collect_views(job.views, *job.board, control);
  const auto fit = fit_lens(*job.board, views.points, views.width_px, views.height_px, job.model);
  const bool vague =
      fit && (fit->boards_apart < kLeastApart ||
              (fit->focal_sd_px.array() > kFocalKnown * fit->camera.focal_px.array()).any());
  if (!fit || vague)
    throw InputError(
        describe({job.views.string(), 0, ""},
                 fmt::format("{} views that do not tell the focal length", views.points.size()),
                 "views of a board that is tilted by 30 degrees and more, to all sides"));
  out.camera = fit->camera;
  out.camera.rotation.setIdentity();
  out.camera.translation.setZero();
  out.lens_rms_px = fit->rms_px;
  out.views = views.points.size();
  if (fit->focal_sd_px.allFinite()) out.focal_sd = fit->focal_sd_px;
  for (size_t v = 0; v < views.points.size(); ++v)
    add_residuals("lens", views.frames[v], views.points[v], fit->misses[v], out);
  if (fit->rms_px > kUsualLensRms)
    out.notes.push_back(
        "the lens misses by more than usual: is the board flat, the picture sharp, "
        "--model rich enough?");
  if (!lens_covers_image(out.camera))
    out.notes.push_back(
        "the lens model folds over in the corners: take the board there, or choose "
        "a simpler --model");
  pictures[kLensPicture] = lens_picture(views, *fit);
}

// Points of a board on the floor: x along its rows, z up, and therefore y against its columns.
MeasuredPoints floor_points(const Board& board, const BoardViews& view) {
  MeasuredPoints out;
  out.pixels = view.points.front();
  for (const Eigen::Vector3d& point : board_points(board)) {
    out.world.emplace_back(point.x(), -point.y(), 0);
    out.lines.push_back(view.frames.front());
  }
  return out;
}

Image first_picture(const fs::path& source, const Camera& camera) {
  Image image = black_image(camera.width_px, camera.height_px);
  if (source.empty()) return image;
  FrameSource(source, image.size()).read(image);
  return image;
}

void check_size(const CalibrateJob& job, const Camera& lens, const BoardViews& view) {
  if (view.width_px == lens.width_px && view.height_px == lens.height_px) return;
  throw InputError(describe({job.floor.string(), 0, ""},
                            fmt::format("{}x{} px", view.width_px, view.height_px),
                            fmt::format("{}x{} px, as the lens", lens.width_px, lens.height_px)));
}

void find_place(const CalibrateJob& job, CalibrateOutcome& out, Pictures& pictures) {
  MeasuredPoints points;
  Image picture;
  if (job.points.empty()) {
    const BoardViews view = find_floor_board(job.floor, *job.board);
    check_size(job, out.camera, view);
    points = floor_points(*job.board, view);
    picture = view.picture;
    if (!has_one_origin(*job.board))
      out.notes.push_back(
          "this board looks the same from either end: with several cameras, see in "
          "the pictures that all have one origin, or use a chessboard whose columns "
          "+ rows are odd");
  } else {
    points = read_measured_points(job.points);
    picture = first_picture(job.floor, out.camera);
    if (points.pixels.size() == 4)
      out.notes.push_back("four points fit by themselves; more would tell of mistakes");
  }
  const std::string file = job.points.empty() ? job.floor.string() : job.points.string();
  const PlaceFit fit = checked_place(out.camera, points, file);
  out.camera = fit.camera;
  out.place_rms_px = fit.rms_px;
  add_residuals("place", points.lines.front(), points.pixels, fit.misses, out);
  pictures[kPlacePicture] = place_picture(picture, fit, points);
}

std::string residuals_csv(const CalibrateOutcome& outcome) {
  std::string out = "of,frame,point,u,v,miss_u,miss_v\n";
  for (const CalibrationResidual& r : outcome.residuals)
    out += fmt::format("{},{},{},{:.3f},{:.3f},{:.3f},{:.3f}\n", r.of, r.frame, r.point,
                       r.found_px.x(), r.found_px.y(), r.miss_px.x(), r.miss_px.y());
  return out;
}

std::string run_text(const CalibrateJob& job, const CalibrateOutcome& outcome) {
  const BuildFacts& facts = build_facts();
  nlohmann::ordered_json out{
      {"program", {{"name", "walktrack"}, {"version", facts.version}, {"commit", facts.commit}}},
      {"command", "calibrate"},
      {"command_line", job.command_line},
      {"views", outcome.views},
      {"notes", outcome.notes}};
  if (outcome.lens_rms_px) out["lens_rms_px"] = *outcome.lens_rms_px;
  if (outcome.place_rms_px) out["place_rms_px"] = *outcome.place_rms_px;
  return out.dump(2) + "\n";
}

}  // namespace

CalibrateOutcome calibrate(const CalibrateJob& job, const JobControl& control) {
  require(job);
  const Outputs outputs = outputs_of(job);
  refuse_what_is_not_ours(outputs);
  refuse_existing(job.output / outputs.last, job.overwrite);
  CalibrateOutcome out;
  Pictures pictures;
  if (job.views.empty()) {
    out.camera = read_calibration(job.camera, job.name);
  } else {
    find_lens(job, control, out, pictures);
  }
  if (job.floor.empty() && job.points.empty()) {
    out.notes.push_back(
        fmt::format("the camera has no place yet: --camera {} with --floor or --points, and "
                    "another folder for -o, gives it one",
                    (job.output / outputs.last).string()));
  } else {
    find_place(job, out, pictures);
  }
  const ResultFolder folder(outputs, job.overwrite);
  for (const auto& [ending, image] : pictures) folder.write(job.name + ending, png_bytes(image));
  folder.write(job.name + kResiduals, residuals_csv(out));
  folder.write(job.name + kToml, toml_from_cameras({{job.name, out.camera}}));
  folder.write(job.name + kRun, run_text(job, out));
  folder.write(job.name + kCalibration, opencv_from_camera(out.camera));
  return out;
}

std::string calibrate_text(const CalibrateOutcome& outcome) {
  const Camera& camera = outcome.camera;
  std::string out = fmt::format("{}x{} px, focal length {:.1f} {:.1f} px", camera.width_px,
                                camera.height_px, camera.focal_px.x(), camera.focal_px.y());
  if (outcome.focal_sd)
    out += fmt::format(" (± {:.1f} {:.1f})", outcome.focal_sd->x(), outcome.focal_sd->y());
  out += fmt::format(", centre {:.1f} {:.1f} px\n", camera.centre_px.x(), camera.centre_px.y());
  if (outcome.lens_rms_px)
    out += fmt::format("lens: {} views, reprojection error {:.3f} px rms\n", outcome.views,
                       *outcome.lens_rms_px);
  if (outcome.place_rms_px) {
    const Eigen::Vector3d at = camera_centre(camera);
    const CameraInspection view = inspect_camera(camera, 1.75);
    out += fmt::format(
        "place: {:.3f} {:.3f} {:.3f} m, looking {:.1f} deg down, reprojection error {:.3f} px "
        "rms\n",
        at.x(), at.y(), at.z(), deg_from_rad(view.tilt), *outcome.place_rms_px);
  }
  for (const std::string& note : outcome.notes) out += "note: " + note + "\n";
  return out;
}

}  // namespace jobs
}  // namespace walktrack
