#include "tracker/moves/global_pose.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "core/log_weights.h"

namespace walktrack {
inline namespace tracker {

namespace {

using Eigen::Vector2d;
using Matrix = Eigen::Matrix<double, 5, 5>;

// The angles of the global pose among the residual angles, in its order.
constexpr std::array<ResidualAngle, 3> kAngles{kHeading, kCrouch, kTilt};

// Its heading is at most half a turn from `near`: particles that walk towards -x have headings of
// about -pi and of about pi.
GlobalPose global_pose_of(const WalkerParticle& particle, double near) {
  const double heading =
      near + std::remainder(particle.residual[kHeading] - near, 2 * std::numbers::pi);
  GlobalPose out;
  out << particle.pose.root.head<2>(), heading, particle.residual[kCrouch],
      particle.residual[kTilt];
  return out;
}

// Lower triangular factor of a covariance that may be singular.
Matrix factor_of(const Matrix& covariance) {
  Matrix factor = Matrix::Zero();
  for (int j = 0; j < 5; ++j) {
    const double left = covariance(j, j) - factor.row(j).head(j).squaredNorm();
    if (left <= 1e-12) continue;
    factor(j, j) = std::sqrt(left);
    for (int i = j + 1; i < 5; ++i) {
      const double shared = factor.row(i).head(j).dot(factor.row(j).head(j));
      factor(i, j) = (covariance(i, j) - shared) / factor(j, j);
    }
  }
  return factor;
}

// Changes the pose a frame ago in the same way as its successor, which was `was` and is `is`.
void follow(const Pose& was, const Pose& is, Pose& before) {
  const double turn = is.heading - was.heading;
  const Vector2d arm = before.root.head<2>() - was.root.head<2>();
  before.root.head<2>() = is.root.head<2>() + Eigen::Rotation2Dd(turn) * arm;
  before.root.z() += is.root.z() - was.root.z();
  before.heading += turn;
  before.tilt += is.tilt - was.tilt;
  for (size_t i = 0; i < 2; ++i) {
    before.legs[i].hip_flexion += is.legs[i].hip_flexion - was.legs[i].hip_flexion;
    before.legs[i].knee_flexion += is.legs[i].knee_flexion - was.legs[i].knee_flexion;
  }
}

}  // namespace

GlobalPoseSpread global_pose_spread(std::span<const WalkerParticle> particles,
                                    std::span<const double> log_weights) {
  const std::vector<double> weights = normalised_weights(log_weights);
  GlobalPoseSpread out;
  const auto heaviest = static_cast<size_t>(std::ranges::max_element(weights) - weights.begin());
  const double near = weights.empty() ? 0 : particles[heaviest].residual[kHeading];
  for (size_t i = 0; i < particles.size(); ++i)
    if (weights[i] > 0) out.mean += weights[i] * global_pose_of(particles[i], near);
  Matrix covariance = Matrix::Zero();
  for (size_t i = 0; i < particles.size(); ++i) {
    if (!(weights[i] > 0)) continue;
    const GlobalPose away = global_pose_of(particles[i], near) - out.mean;
    covariance += weights[i] * away * away.transpose();
  }
  out.factor = factor_of(covariance);
  return out;
}

void move_global_pose(const MotionContext& context, const GlobalPoseSpread& spread,
                      double step_size, WalkerParticle& particle, Rng& rng) {
  const GlobalPose now = global_pose_of(particle, spread.mean[2]);
  GlobalPose normal;
  for (double& z : normal) z = rng.normal();
  const GlobalPose wanted = spread.mean +
                            std::sqrt(1 - step_size * step_size) * (now - spread.mean) +
                            step_size * (spread.factor * normal);
  const Pose was = particle.pose;
  for (size_t k = 0; k < kAngles.size(); ++k) {
    const double change = wanted[2 + int(k)] - now[2 + int(k)];
    particle.predicted_residual[kAngles[k]] += change;
    particle.residual_before[kAngles[k]] += change;
  }
  context.moves.apply_noise(context, particle);
  const Vector2d shift = wanted.head<2>() - particle.pose.root.head<2>();
  particle.predicted_ball += shift;
  particle.ball += shift;
  particle.pose.root.head<2>() += shift;
  follow(was, particle.pose, particle.pose_before);
}

}  // namespace tracker
}  // namespace walktrack
