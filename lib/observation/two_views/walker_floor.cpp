#include "observation/two_views/walker_floor.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "core/conventions.h"
#include "core/median.h"

namespace walktrack {
inline namespace observation {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;
using enum KeypointName;

namespace {

// Shares of the stature (Winter 2009, figure 4.1): eyes and ears above the ankle, minus 0.012
// because hips are lower in walking than in standing; the ankle above the floor, with a sole.
constexpr double kEyesAboveAnkle = 0.936 - 0.039 - 0.012;
constexpr double kAnkle = 0.039, kSole_m = 0.01;
// Deviations of people and telephones from upright, and of the ankles of supporting legs from a
// common height. By hand.
constexpr double kTrunkSidewaysSd_deg = 2, kTrunkForwardSd_deg = 4, kRollSd_deg = 2,
                 kTiltSd_deg = 10, kStanceSd_m = 0.03;

Vector3d up_of(const Vector2d& lean) { return Vector3d(lean.x(), -1, lean.y()).normalized(); }

Vector3d mean(const BodyPoints& body, KeypointName a, KeypointName b) {
  return 0.5 * (point_of(body, a) + point_of(body, b));
}

double low_ankle(const BodyPoints& body, const Vector3d& up) {
  return std::min(point_of(body, kLeftAnkle).dot(up), point_of(body, kRightAnkle).dot(up));
}

double eyes_and_ears(const BodyPoints& body, const Vector3d& up) {
  return 0.5 * (mean(body, kLeftEye, kRightEye) + mean(body, kLeftEar, kRightEar)).dot(up);
}

// Horizontal offset of the shoulders from the ankles, to the subject's right and forward, per
// length.
Vector2d lean_of(const BodyPoints& body, const Vector3d& up) {
  const Vector3d hips = point_of(body, kRightHip) - point_of(body, kLeftHip);
  const Vector3d right = (hips - hips.dot(up) * up).normalized();
  const Vector3d trunk =
      (mean(body, kLeftShoulder, kRightShoulder) - mean(body, kLeftAnkle, kRightAnkle))
          .normalized();
  return {trunk.dot(right), trunk.dot(up.cross(right))};
}

template <typename Of>
double median_over(std::span<const BodyPoints> bodies, const Of& of) {
  std::vector<double> values;
  for (const BodyPoints& body : bodies) values.push_back(of(body));
  return median_of(std::move(values));
}

}  // namespace

FloorFit::FloorFit(std::span<const BodyPoints> bodies, const CameraPair& pair, double weight,
                   double stature)
    : bodies_(bodies), pair_(pair), weight_(weight), stature_(stature) {
  // The scale follows from the vertical, on which it hardly depends.
  constexpr int kPasses = 3;
  VectorXd x = VectorXd::Zero(3);
  for (int pass = 0; pass < kPasses; ++pass) {
    const Vector3d up = up_of(x.head<2>());
    const double metres = scale(up);
    x[2] = metres * median_over(bodies_, [&](const auto& body) { return low_ankle(body, up); });
    fit_ = minimise_squares([&](const VectorXd& at) { return residuals(at, metres); }, x);
    x = fit_.x;
  }
}

double FloorFit::scale(const Vector3d& up) const {
  const double tall = median_over(bodies_, [&](const BodyPoints& body) {
    return eyes_and_ears(body, up) - low_ankle(body, up);
  });
  return kEyesAboveAnkle * stature_ / std::max(tall, 1e-9);
}

VectorXd FloorFit::residuals(const VectorXd& x, double scale) const {
  const Vector3d up = up_of(x.head<2>()), other = pair_.second_from_first * up;
  const auto count = static_cast<Eigen::Index>(bodies_.size());
  VectorXd out(count + 6);
  Vector2d lean = Vector2d::Zero();
  for (Eigen::Index m = 0; m < count; ++m) {
    const BodyPoints& body = bodies_[static_cast<size_t>(m)];
    const double above = (scale * low_ankle(body, up) - x[2]) / kStanceSd_m;
    // Less than the square for a foot that is on its toes or detected wrongly.
    out[m] =
        weight_ * std::copysign(std::sqrt(2 * (std::sqrt(1 + 0.5 * above * above) - 1)), above);
    lean += lean_of(body, up) / static_cast<double>(count);
  }
  out.tail<6>() << lean.x() / rad_from_deg(kTrunkSidewaysSd_deg),
      lean.y() / rad_from_deg(kTrunkForwardSd_deg), up.x() / rad_from_deg(kRollSd_deg),
      up.z() / rad_from_deg(kTiltSd_deg), other.x() / rad_from_deg(kRollSd_deg),
      other.z() / rad_from_deg(kTiltSd_deg);
  return out;
}

WalkerFloor FloorFit::floor(const Vector2d& more_lean) const {
  const Vector3d up = up_of(fit_.x.head<2>() + more_lean);
  const double metres = scale(up);
  const double ankles =
      metres * median_over(bodies_, [&](const auto& body) { return low_ankle(body, up); });
  return {up, ankles - kAnkle * stature_ - kSole_m, metres};
}

}  // namespace observation
}  // namespace walktrack
