// Which way is up, how high the floor is and how large everything, from one walker's joints
// (two_views.h).
#pragma once

#include <optional>
#include <span>

#include "core/dense.h"
#include "observation/two_views/walker_rays.h"

namespace walktrack {
inline namespace observation {

struct WalkerFloor {
  Eigen::Vector3d up;  // in the first camera's axes
  double height;       // of the floor along it, m
  double scale;        // metres of one unit
};

class FloorFit {
 public:
  // At least one body. `weight`: how much a moment counts among the others.
  FloorFit(std::span<const BodyPoints> bodies, const CameraPair& pair, double weight,
           double stature);

  // Of the lean of the vertical in the first camera's axes (two numbers, rad) and of how high
  // stance ankles are (m).
  const LeastSquaresFit& fit() const { return fit_; }
  // With that much more lean.
  WalkerFloor floor(const Eigen::Vector2d& more_lean = Eigen::Vector2d::Zero()) const;

 private:
  double scale(const Eigen::Vector3d& up) const;
  Eigen::VectorXd residuals(const Eigen::VectorXd& x, double scale) const;

  std::span<const BodyPoints> bodies_;
  const CameraPair& pair_;
  double weight_, stature_;
  LeastSquaresFit fit_;
};

// What the share of the stature that eyes and ears are above the ankles is uncertain by, share.
inline constexpr double kEyesSd = 0.017;

}  // namespace observation
}  // namespace walktrack
