// The path of the ankle of a rigid foot that rolls over heel and ball and swings. Pitch of the sole
// in radians, > 0 heel up; metres.
#pragma once

#include <Eigen/Core>

#include "body/subject.h"

namespace walktrack {
inline namespace synth {

// Rises from 0 to 1 with s; its slope is zero at both ends and outside.
double smooth_step(double s);

// Position in front of the ankle's place with a flat sole, and height above the ground: the sole
// rotates about the heel's point of contact or about the ball's.
Eigen::Vector2d rolled_ankle(const BodyLengths& lengths, double pitch);

// Height above the ground at the share `swing` (0 to 1) of the time from the lift to the next
// strike. The lowest point of the sole is at most `clearance` high. People's toes are bent when the
// foot lifts and straighten in the first part of the swing; until then the tip of a rigid foot is
// below the ground.
double swinging_ankle(const BodyLengths& lengths, double pitch, double swing, double clearance);

// A position with its first and second derivative by the share of the swing.
struct PathEnd {
  Eigen::Vector2d place, velocity, acceleration;
};

// The quintic polynomial between two ends.
Eigen::Vector2d swing_path(const PathEnd& from, const PathEnd& to, double swing);

}  // namespace synth
}  // namespace walktrack
