// The global pose of a walker, its place and direction: the slow coordinates of a particle.
//
// One frame hardly determines the distance from the camera or the heading; many frames together do.
// Because the filter resamples in every frame, all particles soon descend from one and share its
// global pose, so that the set no longer shows how uncertain that is. Moves of the global pose
// restore the spread: the predicted global pose is taken as normal, N(mean, S), with the set's own
// mean and covariance, and
//   c' = mean + sqrt(1 - b^2) (c - mean) + b n,   n ~ N(0, S)
// leaves that distribution invariant (a regularised particle filter with a Metropolis-Hastings
// step, Musso, Oudjane & Le Gland 2001, in these coordinates only). The body moves rigidly together
// with its past frame, so that gait and motion stay the same.
#pragma once

#include <span>

#include <Eigen/Core>

#include "tracker/motion/propagate.h"

namespace walktrack {
inline namespace tracker {

// Root x, y (m), heading, crouch, tilt (rad).
using GlobalPose = Eigen::Matrix<double, 5, 1>;

struct GlobalPoseSpread {
  GlobalPose mean = GlobalPose::Zero();
  Eigen::Matrix<double, 5, 5> factor = Eigen::Matrix<double, 5, 5>::Zero();  // S = factor factor^T
};

// Mean and covariance of particles to which noise has been applied; those with log-weights of
// -infinity are left out.
GlobalPoseSpread global_pose_spread(std::span<const WalkerParticle> particles,
                                    std::span<const double> log_weights);

// Proposes another global pose; step_size in (0, 1].
void move_global_pose(const MotionContext& context, const GlobalPoseSpread& spread,
                      double step_size, WalkerParticle& particle, Rng& rng);

}  // namespace tracker
}  // namespace walktrack
