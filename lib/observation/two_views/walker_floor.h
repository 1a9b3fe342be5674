// Estimates the vertical direction, the height of the floor and the scale from one subject's joints
// (two_views.h).
#pragma once

#include <optional>
#include <span>

#include "core/dense.h"
#include "observation/two_views/walker_rays.h"

namespace walktrack {
inline namespace observation {

struct WalkerFloor {
  Eigen::Vector3d up;  // vertical direction in the first camera's axes
  double height;       // of the floor along it, m
  double scale;        // metres in one unit
};

class FloorFit {
 public:
  // For at least one body. `weight`: weight of each moment.
  FloorFit(std::span<const BodyPoints> bodies, const CameraPair& pair, double weight,
           double stature);

  // Estimates the lean of the vertical in the first camera's axes (two numbers, rad) and the height
  // of the ankles of supporting legs (m).
  const LeastSquaresFit& fit() const { return fit_; }
  // The floor with additional lean.
  WalkerFloor floor(const Eigen::Vector2d& more_lean = Eigen::Vector2d::Zero()) const;

 private:
  double scale(const Eigen::Vector3d& up) const;
  Eigen::VectorXd residuals(const Eigen::VectorXd& x, double scale) const;

  std::span<const BodyPoints> bodies_;
  const CameraPair& pair_;
  double weight_, stature_;
  LeastSquaresFit fit_;
};

// Relative uncertainty of the height of eyes and ears above the ankles.
inline constexpr double kEyesSd = 0.017;

}  // namespace observation
}  // namespace walktrack
