// The estimate of one frame by weighted particles: joints with their spread, the mean pose, and the
// supporting foot. Positions in metres in world axes.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "body/joint_angles.h"
#include "tracker/state/particle.h"

namespace walktrack {
inline namespace tracker {

// Weighted distribution of one number.
struct Spread {
  double mean = 0, sd = 0, p05 = 0, p95 = 0;
};

struct FrameEstimate {
  size_t joint_count = 0;  // joints modelled: with arms all, without them the first eleven
  JointPositions joints;   // weighted means
  std::array<std::array<Spread, 3>, kJointCount> spread{};  // by joint and axis
  Pose pose;                                                // weighted means of the pose's numbers
  std::array<Spread, kJointAngleCount> angles{};            // rad; about those of `pose`
  double left_stance = 0;  // probability that the left foot carries the body
  // s, from when the likelier of the feet took over the body's weight until now
  Spread since_transfer;
  double speed = 0;  // m/s over the ground, mean
};

// Weights sum to one. Joints that the body does not model stay at zero.
FrameEstimate estimate_frame(const BodyModel& model, std::span<const WalkerParticle> particles,
                             std::span<const double> weights, double dt, int threads);

// Moves the bands of `to`, which are still those of `from`, by the displacement of its joints and
// its pose.
void shift_bands(const FrameEstimate& from, FrameEstimate& to);

// Mean, standard deviation and weighted 5 % and 95 % quantiles of `values`.
Spread weighted_spread(std::span<const double> values, std::span<const double> weights);

}  // namespace tracker
}  // namespace walktrack
