// `walktrack calibrate`: estimates one camera's lens from views of a board, and its pose from a
// board on the floor or from measured points. It writes into a folder:
//   <name>.yaml           the calibration for scenes (OpenCV); <name>.toml the same for Pose2Sim
//   <name>_residuals.csv  every point: its detected position and the distance of its projection, px
//   <name>_lens.png       the points of all views with their residuals; <name>_place.png the
//                         ground in the image
//   <name>_run.json       the origin of the files
//
// World axes: with a board on the floor its first point (observation/calibration/board.h) is the
// origin, x runs along its rows and z is up. With measured points they are the axes of the points.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/job_control.h"
#include "observation/calibration/board.h"
#include "observation/calibration/camera_fit.h"

namespace walktrack {
inline namespace jobs {

struct CalibrateJob {
  std::string name = "cam0";
  std::optional<Board> board;  // for views and for a board on the floor
  LensModel model = LensModel::kBrown;
  std::filesystem::path views;   // video or images of the board in different poses; or
  std::filesystem::path camera;  // a calibration file with the lens
  std::filesystem::path
      floor;  // picture or video of the camera in its place, with a board on the floor,
  std::filesystem::path points;  // or with the ground on which these points were measured
  std::filesystem::path output;
  bool overwrite = false;
  std::vector<std::string> command_line;
};

// One detected point with its residual.
struct CalibrationResidual {
  std::string of;  // "lens" or "place"
  int frame;       // of the source; for points, the line in the file
  int point;
  Eigen::Vector2d found_px, miss_px;
};

struct CalibrateOutcome {
  Camera camera;
  std::optional<double> lens_rms_px, place_rms_px;
  size_t views = 0;                         // from which the lens was estimated
  std::optional<Eigen::Vector2d> focal_sd;  // px
  std::vector<CalibrationResidual> residuals;
  std::vector<std::string> notes;  // notes for the user
};

// Throws a UsageError for an incomplete job; an InputError with advice for views and points from
// which no camera can be estimated.
CalibrateOutcome calibrate(const CalibrateJob& job, const JobControl& control);

// A description of the outcome.
std::string calibrate_text(const CalibrateOutcome& outcome);

}  // namespace jobs
}  // namespace walktrack
