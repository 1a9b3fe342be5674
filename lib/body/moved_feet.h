// Feet of a skeleton put elsewhere. Lengths stay, and so does all that is not named; where a joint
// that is needed is unknown (NaN), nothing changes.
#pragma once

#include <Eigen/Core>

#include "body/pose.h"

namespace walktrack {
inline namespace body {

// The foot `by` (m, world) further over the ground: the leg turns about its hip as it is, the knee
// no more bent than before, and the foot keeps its attitude. Its height changes by the little that
// takes: a straight leg reaches its knee's angle to 4 degrees for 4 mm of it. Nothing changes
// where the leg is too short for it.
void turn_leg(Side side, const Eigen::Vector2d& by, JointPositions& joints);

// A toe below the ground, z = 0, is put on it: the foot turns about its ankle, up the way it
// points. Nothing changes where the ankle is below the ground itself.
void lift_toe(Side side, JointPositions& joints);

}  // namespace body
}  // namespace walktrack
