#include "tracker/smooth/model_error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/LU>

#include "core/conventions.h"
#include "core/dense.h"

namespace walktrack {
inline namespace tracker {

namespace {

// Measured (tracker/reports/bands.md).
constexpr double kFigureError = 0.018;  // m
// Where no camera sees the figure, its place is known to this. By hand.
constexpr double kUnseen = 1;  // m
// A figure that walks out of the picture is expected to walk on: by this share of the way outside
// the place is wrong. By hand: speeds change by a tenth from step to step.
constexpr double kDriftOutside = 0.2;
// Share of the variance that lasts for a video, and how fast the rest passes: measured on the same
// walks.
constexpr double kLasting = 0.6;
constexpr double kPassingTime = 0.12;  // s

// Standard deviations over the ground and upwards, m.
struct JointError {
  double level, upright;
};

// Standard deviation of the height of knees among people of one stature: 2.8 cm among all men (5 to
// 95 % of them: 51.4 to 60.6 cm, Gordon et al. 1989, NATICK/TR-89/044). A correlation of .84 with
// the stature, by hand, leaves 1.5. All people that the other errors were measured on had one
// skeleton.
constexpr double kKneeHeight = 0.015;  // m

// Beyond the figure's; left and right alike. Pelvis and ankles have no error beyond it.
JointError joint_error(size_t joint) {
  switch (static_cast<Joint>(joint)) {
    case Joint::kNeck:
      return {0.009, 0.018};
    case Joint::kHead:
      return {0.025, 0.031};
    case Joint::kLeftHip:
    case Joint::kRightHip:
      return {0.009, 0.005};
    case Joint::kLeftKnee:
    case Joint::kRightKnee:
      return {0, kKneeHeight};
    case Joint::kLeftToe:
    case Joint::kRightToe:
      return {0.010, 0};
    default:
      return {0, 0};
  }
}

// Standard deviation, rad.
double angle_error(size_t angle) {
  switch (angle) {
    case kPelvisTilt:
      return rad_from_deg(1.6);
    case kTrunkTilt:
      return rad_from_deg(1.4);
    case kPelvisList:
    case kLumbarBending:
      return rad_from_deg(4.5);
    case kPelvisRotation:
      return rad_from_deg(10.4);
    case kHipFlexionR:
    case kHipFlexionL:
      return rad_from_deg(3.7);
    case kHipAdductionR:
    case kHipAdductionL:
      return rad_from_deg(5.1);
    case kHipRotationR:
    case kHipRotationL:
      return rad_from_deg(9.2);
    case kKneeAngleR:
    case kKneeAngleL:
      return rad_from_deg(4.6);
    case kAnkleAngleR:
    case kAnkleAngleL:
      return rad_from_deg(6.8);
    default:
      return 0;  // the lumbar angles that our body has not are exact zeros
  }
}

void widen(double sd, Spread& spread) {
  // A few outliers may have pulled the mean out of its own band.
  const double low = std::max(0.0, spread.mean - spread.p05);
  const double high = std::max(0.0, spread.p95 - spread.mean);
  spread.sd = std::hypot(spread.sd, sd);
  spread.p05 = spread.mean - std::hypot(low, kBandQuantile * sd);
  spread.p95 = spread.mean + std::hypot(high, kBandQuantile * sd);
}

// What the cameras know of a figure's end: the sum of J'J, in metres, of those that see it; if none
// does, of the one that it left last, and how far away from that image it is, m.
struct EndView {
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  double outside = std::numeric_limits<double>::infinity();
};

// Distance of a pixel from the image, px.
double px_outside(const Camera& camera, const Eigen::Vector2d& pixel) {
  const Eigen::Vector2d last(camera.width_px - 0.5, camera.height_px - 0.5);
  return (pixel - pixel.cwiseMax(-0.5).cwiseMin(last)).norm();
}

EndView view_of(std::span<const Camera> cameras, const Eigen::Vector3d& end) {
  EndView out;
  for (const Camera& camera : cameras) {
    const auto at = project_with_jacobian(camera, end);
    if (!at) continue;
    const double metres_per_px = camera_point(camera, end).z() / camera.focal_px.mean();
    const double outside = metres_per_px * px_outside(camera, at->pixel);
    if (outside > out.outside) continue;
    if (outside < out.outside) out = {Eigen::Matrix3d::Zero(), outside};
    const Eigen::Matrix<double, 2, 3> moved = metres_per_px * at->d_pixel_d_point;
    out.information += moved.transpose() * moved;
  }
  if (std::isinf(out.outside)) out.outside = 0;  // no camera faces it, and there is no information
  return out;
}

}  // namespace

Eigen::Matrix3d figure_covariance(std::span<const Camera> cameras, const Eigen::Vector3d& head,
                                  const Eigen::Vector3d& feet) {
  const double unseen = (kFigureError * kFigureError) / (kUnseen * kUnseen);
  Eigen::Matrix3d fitted = unseen * Eigen::Matrix3d::Identity(), spread = fitted;
  for (const Eigen::Vector3d* end : {&head, &feet}) {
    const EndView seen = view_of(cameras, *end);
    const double error = kDriftOutside * seen.outside / kFigureError;
    const double weight = 1 / (1 + error * error);
    fitted += weight * seen.information;
    spread += weight * seen.information * seen.information.transpose();
  }
  const Eigen::Matrix3d inverse = fitted.inverse();
  return kFigureError * kFigureError * inverse * spread * inverse;
}

Eigen::Matrix3d figure_root(std::span<const Camera> cameras, const JointPositions& joints) {
  const Eigen::Vector3d feet = 0.5 * (joints[Joint::kLeftAnkle] + joints[Joint::kRightAnkle]);
  const Eigen::Matrix3d covariance = figure_covariance(cameras, joints[Joint::kHead], feet);
  const auto [values, axes] = symmetric_eigen(covariance);
  return axes * values.cwiseSqrt().asDiagonal() * axes.transpose();
}

double ModelErrorDraw::Process::value() const {
  return std::sqrt(kLasting) * lasting + std::sqrt(1 - kLasting) * passing;
}

ModelErrorDraw::ModelErrorDraw(uint64_t seed, uint32_t draw)
    : rng_(seed, Purpose::kModelError, 0, draw), share_(rng_.uniform()) {
  const auto begin = [&](Process& process) {
    process = {rng_.normal(), rng_.normal(), rng_.normal() / kPassingTime};
  };
  std::for_each(figure_.begin(), figure_.end(), begin);
  for (auto& joint : joints_) std::for_each(joint.begin(), joint.end(), begin);
}

// The process and its rate one step later, exactly (Hartikainen & Sarkka, MLSP 2010): the
// transition of a critically damped oscillator, and the noise that keeps both variances what they
// are.
JointPositions ModelErrorDraw::next(double dt, const Eigen::Matrix3d& figure) {
  const double r = dt / kPassingTime, decay = std::exp(-r);
  const Eigen::Matrix2d step =
      decay * Eigen::Matrix2d{{1 + r, r}, {-r, 1 - r}};  // of (value, rate * kPassingTime)
  const Eigen::Matrix2d noise =
      cholesky_root(Eigen::Matrix2d::Identity() - step * step.transpose());
  const auto advance = [&](Process& process) {
    const Eigen::Vector2d now =
        step * Eigen::Vector2d(process.passing, process.rate * kPassingTime) +
        noise * Eigen::Vector2d(rng_.normal(), rng_.normal());
    process.passing = now[0];
    process.rate = now[1] / kPassingTime;
  };
  const auto values = [](const std::array<Process, 3>& of) {
    return Eigen::Vector3d(of[0].value(), of[1].value(), of[2].value());
  };
  if (std::exchange(begun_, true)) {
    std::for_each(figure_.begin(), figure_.end(), advance);
    for (auto& joint : joints_) std::for_each(joint.begin(), joint.end(), advance);
  }
  JointPositions out;
  for (size_t j = 0; j < kJointCount; ++j) {
    const auto [level, upright] = joint_error(j);
    out.at[j] = figure * values(figure_) +
                Eigen::Vector3d(level, level, upright).cwiseProduct(values(joints_[j]));
  }
  return out;
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
