// Where walkers are and which way they go: the slow coordinates of a particle.
//
// A frame hardly tells the distance from the camera or the heading; many frames together do. A
// filter resamples in every frame, so that soon all particles descend from one and share its
// course: the set forgets how uncertain the course was. Moves along the course keep it alive: the
// prediction's course is taken as normal, N(mean, S), with the set's own mean and covariance, and
//   c' = mean + sqrt(1 - b^2) (c - mean) + b n,   n ~ N(0, S)
// leaves that invariant (a regularised particle filter with a Metropolis-Hastings step, Musso,
// Oudjane & Le Gland 2001, in these coordinates alone). The body moves rigidly, with its past
// frame, so that its gait and its motion stay what they are.
#pragma once

#include <span>

#include <Eigen/Core>

#include "tracker/motion/propagate.h"

namespace walktrack {
inline namespace tracker {

// Root x, y (m), heading, crouch, tilt (rad).
using GlobalPose = Eigen::Matrix<double, 5, 1>;

struct CourseSpread {
  GlobalPose mean = GlobalPose::Zero();
  Eigen::Matrix<double, 5, 5> factor = Eigen::Matrix<double, 5, 5>::Zero();  // S = factor factor^T
};

// Of realised particles; log-weights of -infinity count for nothing.
CourseSpread course_spread(std::span<const WalkerParticle> particles,
                           std::span<const double> log_weights);

// Proposes another course; step_size in (0, 1].
void move_global_pose(const MotionContext& context, const CourseSpread& spread, double step_size,
                      WalkerParticle& particle, Rng& rng);

}  // namespace tracker
}  // namespace walktrack
