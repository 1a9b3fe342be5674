#include "tracker/smooth/model_error.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

#include "core/conventions.h"

namespace walktrack {
inline namespace tracker {

namespace {

// Measured (tracker/reports/bands.md).
constexpr double kFigureError = 0.02;  // m
// Where no camera sees the figure, its place is known to this. By hand.
constexpr double kUnseen = 1;        // m
constexpr double kQuantile = 1.645;  // of the normal distribution, at 95 %

// Standard deviations over the ground and upwards, m.
struct JointError {
  double level, upright;
};

// Left and right alike. Arms are not in the walks that were measured: they get the feet's.
JointError joint_error(size_t joint) {
  switch (static_cast<Joint>(joint)) {
    case Joint::kPelvis:
      return {0, 0.005};
    case Joint::kNeck:
      return {0.008, 0.038};
    case Joint::kHead:
      return {0.009, 0.060};
    case Joint::kLeftHip:
    case Joint::kRightHip:
      return {0.007, 0.006};
    case Joint::kLeftKnee:
    case Joint::kRightKnee:
      return {0, 0.014};
    case Joint::kLeftAnkle:
    case Joint::kRightAnkle:
      return {0.004, 0.008};
    default:
      return {0.020, 0.007};
  }
}

// Standard deviation, rad.
double angle_error(size_t angle) {
  switch (angle) {
    case kPelvisTilt:
    case kTrunkTilt:
      return rad_from_deg(1);
    case kPelvisList:
    case kLumbarBending:
      return rad_from_deg(3);
    case kPelvisRotation:
      return rad_from_deg(6.5);
    case kHipFlexionR:
    case kHipFlexionL:
      return rad_from_deg(3.9);
    case kHipAdductionR:
    case kHipAdductionL:
      return rad_from_deg(3.4);
    case kHipRotationR:
    case kHipRotationL:
      return rad_from_deg(6.9);
    case kKneeAngleR:
    case kKneeAngleL:
      return rad_from_deg(4.8);
    case kAnkleAngleR:
    case kAnkleAngleL:
      return rad_from_deg(7.2);
    default:
      return 0;  // the lumbar angles that our body has not are exact zeros
  }
}

void widen(double sd, Spread& spread) {
  // A few strays may have pulled the mean out of its own band.
  const double low = std::max(0.0, spread.mean - spread.p05);
  const double high = std::max(0.0, spread.p95 - spread.mean);
  spread.sd = std::hypot(spread.sd, sd);
  spread.p05 = spread.mean - std::hypot(low, kQuantile * sd);
  spread.p95 = spread.mean + std::hypot(high, kQuantile * sd);
}

}  // namespace

Eigen::Matrix3d figure_covariance(std::span<const Camera> cameras, const Eigen::Vector3d& head,
                                  const Eigen::Vector3d& feet) {
  Eigen::Matrix3d information =
      Eigen::Matrix3d::Identity() * (kFigureError * kFigureError) / (kUnseen * kUnseen);
  for (const Camera& camera : cameras) {
    for (const Eigen::Vector3d* end : {&head, &feet}) {
      const auto seen = project_with_jacobian(camera, *end);
      if (!seen || !inside_image(camera, seen->pixel)) continue;
      const double metres_per_px = camera_point(camera, *end).z() / camera.focal_px.mean();
      const Eigen::Matrix<double, 2, 3> moved = metres_per_px * seen->d_pixel_d_point;
      information += moved.transpose() * moved;
    }
  }
  return kFigureError * kFigureError * information.inverse();
}

void add_model_error(std::span<const Camera> cameras, double scale, FrameEstimate& estimate) {
  const JointPositions& joints = estimate.joints;
  const Eigen::Vector3d figure =
      figure_covariance(cameras, joints[Joint::kHead],
                        0.5 * (joints[Joint::kLeftAnkle] + joints[Joint::kRightAnkle]))
          .diagonal();
  for (size_t j = 0; j < estimate.joint_count; ++j) {
    const auto [level, upright] = joint_error(j);
    for (size_t axis = 0; axis < 3; ++axis) {
      const double common2 = figure[static_cast<Eigen::Index>(axis)];
      widen(scale * std::hypot(std::sqrt(common2), axis == 2 ? upright : level),
            estimate.spread[j][axis]);
    }
  }
  for (size_t k = 0; k < kJointAngleCount; ++k) widen(scale * angle_error(k), estimate.angles[k]);
}

}  // namespace tracker
}  // namespace walktrack
