// Where the ankle of a rigid foot is while the foot rolls over heel and ball and swings. Pitch of
// the sole in radians, > 0 heel up; metres.
#pragma once

#include <Eigen/Core>

#include "body/subject.h"

namespace walktrack {
inline namespace synth {

// From 0 to 1 with s, level at both ends and beyond.
double smooth_step(double s);

// Ahead of its place when the sole is flat, and over the ground: the sole turns about the heel's
// place on the ground or about the ball's.
Eigen::Vector2d rolled_ankle(const BodyLengths& lengths, double pitch);

// Height over the ground, `swing` (0 to 1) of the way from the lift to the next strike. The lowest
// point of the sole is at most `clearance` high. People's toes are bent when the foot lifts and
// stretch in the first part of the swing; the tip of a rigid foot is below the ground until then.
double swinging_ankle(const BodyLengths& lengths, double pitch, double swing, double clearance);

// A place and how it changes, once and twice, by the share of the swing.
struct PathEnd {
  Eigen::Vector2d place, velocity, acceleration;
};

// The quintic between two ends.
Eigen::Vector2d swing_path(const PathEnd& from, const PathEnd& to, double swing);

}  // namespace synth
}  // namespace walktrack
