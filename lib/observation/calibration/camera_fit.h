// Cameras from points: the lens from views of a board, the pose from points whose world coordinates
// are known. Pixel centres are at integers, lengths are in metres.
//
// The lens is estimated by OpenCV (Zhang, IEEE PAMI 22(11), 2000; fisheye: Kannala & Brandt 2006),
// the pose by SQPnP (Terzakis & Lourakis, ECCV 2020) followed by Levenberg-Marquardt on normalised
// coordinates.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "camera/camera.h"
#include "observation/calibration/board.h"

namespace walktrack {
inline namespace observation {

enum class LensModel {
  kPinhole,   // no distortion
  kBrown,     // k1 k2 p1 p2
  kRational,  // k1 ... k6 p1 p2
  kFisheye,   // four coefficients of the angle
};

using PixelPoints = std::vector<Eigen::Vector2d>;

struct LensFit {
  Camera camera;                    // at its pose relative to the last view's board
  Eigen::Vector2d focal_sd_px;      // standard deviation of the focal lengths; NaN for a fisheye
  std::vector<PixelPoints> misses;  // detected minus projected, of each view's points
  double rms_px = 0;                // of the lengths of these residuals
  double boards_apart = 0;          // rad, largest angle between the boards of two views; parallel
                                    // boards do not determine the focal length, whatever its
                                    // standard deviation
};

// From the points of at least three views of the board, in the order of find_board; nullopt if the
// equations have no solution (all views alike).
std::optional<LensFit> fit_lens(const Board& board, const std::vector<PixelPoints>& views,
                                int width_px, int height_px, LensModel model);

struct PlaceFit {
  Camera camera;       // the given lens at its pose
  PixelPoints misses;  // given minus projected; NaN for a point behind the camera
  double rms_px = 0;   // infinite if a point is behind the camera
};

// From at least four points that are not on one line; nullopt if there is no solution.
std::optional<PlaceFit> fit_place(const Camera& lens, const PixelPoints& pixels,
                                  const std::vector<Eigen::Vector3d>& world);

}  // namespace observation
}  // namespace walktrack
