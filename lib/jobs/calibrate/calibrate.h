// `walktrack calibrate`: one camera's lens from views of a board, and its place from a board on the
// floor or from measured points. Into a folder:
//   <name>.yaml           calibration as scenes use it (OpenCV); <name>.toml the same for Pose2Sim
//   <name>_residuals.csv  every point: where it was found and how far from it it is projected, px
//   <name>_lens.png       all views' points and their misses; <name>_place.png the ground seen
//   <name>_run.json       how the files came about
//
// World axes: with a board on the floor its first point (observation/calibration/board.h) is the
// origin, x runs along its rows, z is up. With measured points they are those of the points.
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
  std::filesystem::path views;   // video or images of the board, held in many ways; or
  std::filesystem::path camera;  // a calibration file whose lens is taken
  std::filesystem::path
      floor;  // picture or video of the camera in its place: a board on the floor,
  std::filesystem::path points;  // or the ground that these points were measured on
  std::filesystem::path output;
  bool overwrite = false;
  std::vector<std::string> command_line;
};

// One found point and the calibration's opinion of it.
struct CalibrationResidual {
  std::string of;  // "lens" or "place"
  int frame;       // of the source; of points, their line in the file
  int point;
  Eigen::Vector2d found_px, miss_px;
};

struct CalibrateOutcome {
  Camera camera;
  std::optional<double> lens_rms_px, place_rms_px;
  size_t views = 0;                         // that the lens was found from
  std::optional<Eigen::Vector2d> focal_sd;  // px
  std::vector<CalibrationResidual> residuals;
  std::vector<std::string> notes;  // what the user should know
};

// UsageError for a job that lacks something; InputError for views and points from which no camera
// follows, with the cure.
CalibrateOutcome calibrate(const CalibrateJob& job, const JobControl& control);

// The outcome for people.
std::string calibrate_text(const CalibrateOutcome& outcome);

}  // namespace jobs
}  // namespace walktrack
