// Feet that stand still while they stand: the last thing that happens to a track.
//
// The drawn foot creeps under the walker's round one, and takes part in every tremble of the
// figure; the sole of a person lies where it lies. So the foot, (ankle + toe) / 2 over the ground,
// is moved by a shift s over time that brings it to one place, p, in each stretch in which its sole
// lies flat, and is small and smooth:
//   minimise over s, p   sum_i |s_i|^2 + (tau^2 / dt^2)^2 |s_(i-1) - 2 s_i + s_(i+1)|^2
//                      + w sum_(flat) |f_i + s_i - p|^2.
// Legs turn about their hips (body/moved_feet.h): footskate cleanup (Kovar, Schreiner & Gleicher,
// SCA 2002), by least squares over the whole video. Toes that point into the ground are lifted in
// every frame. tracker/reports/reported_pose.md says what it changes. Positions in metres, world
// axes.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "body/flat_foot.h"
#include "body/motion.h"
#include "tracker/walker_filter.h"

namespace walktrack {
inline namespace tracker {

// Over the ground, by Side.
using FootShifts = std::array<Eigen::Vector2d, 2>;

// A foot that travels further than this in a stretch does not stand: it was taken for the other
// one, or follows nothing. Such stretches are left alone. By hand.
inline constexpr double kTooFarToStand = 0.4;  // m

// One for each row of the motion; zero in those of unknown feet, and far from any stretch.
std::vector<FootShifts> planting_shifts(const Motion& motion, std::span<const FlatFoot> flat);

// Moves the feet of a frame and of its samples, and lifts their toes out of the ground: joints,
// pose and bands.
void plant_feet(const FootShifts& by, FrameRecord& record);

}  // namespace tracker
}  // namespace walktrack
