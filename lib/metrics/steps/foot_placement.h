// Where a foot points, how it clears the ground, and where it is placed beside the other one.
//
// Directions of walking are those of metrics/steps/walking_direction.h. Metres, degrees; NaN where
// an end of the motion, or a gap in it, leaves a number open. Indices are those of Gait::stances.
#pragma once

#include "metrics/gait.h"

namespace walktrack {
inline namespace metrics {

// A step turns if the direction of walking changes by more than this. By hand: steps of straight
// walks of motion capture have up to 6, those of a turn of 106 in five steps have 12 and more.
inline constexpr double kTurningStep_deg = 10;

// The smallest height of the toe while it swings at 80 % of its highest speed or more, above its
// height while the sole was flat in the stance before (minimum toe clearance: Winter, Phys. Ther.
// 72, 1992; it comes when the toe is fastest). Of the swing after that stance.
double toe_clearance(const Motion& motion, const Gait& gait, size_t stance);

// The angle of the foot's axis, from ankle to toe, to the direction of walking while the sole is
// flat; toes outwards are positive.
double foot_progression_deg(const Motion& motion, const Gait& gait, size_t stance);

// The distance of both ankles across the direction of walking, at the strike.
double width_at_strike(const Motion& motion, const Gait& gait, size_t stance);

// The distance of the foot's place from the line between the places of the other foot before and
// after it (Whittle, Gait Analysis, 2007); it does not depend on any direction of walking.
double walking_base(const Gait& gait, size_t stance);

// The change of the direction of walking from the step before a strike to the step after it, to
// the left positive.
double turn_deg(const Motion& motion, const Gait& gait, size_t stance);

}  // namespace metrics
}  // namespace walktrack
