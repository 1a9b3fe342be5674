// The coordinates of a particle in addition to its walker's state. They follow damped second-order
// Markov processes (tracker/motion/propagate.h): coordinates that the walker does not drive, and
// deviations from those that it drives. They do not act on the walker, whose gait stays the stable
// gait of the prior.
//
// One table states for each coordinate what it moves, in which plane, its mirror image, and its
// process. Code that concerns several of them uses the table. Their order has no meaning, except
// that random numbers are drawn, and files hold them, in the order of ResidualAngle.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <span>

#include "body/pose.h"
#include "core/conventions.h"

namespace walktrack {
inline namespace tracker {

enum ResidualAngle {
  kHeading,
  kList,
  kAbduction,  // of the left leg; likewise for all coordinates in pairs
  kAbductionRight,
  kRotation,
  kRotationRight,
  kAnkle,  // dorsiflexion; that of a stance foot follows from its sole instead
  kAnkleRight,
  kPace,    // logarithm of the ratio of the person's pace to the walker's
  kCrouch,  // additional flexion of both knees, compared with the walker's
  kTilt,
  kThigh,
  kThighRight,
  kShank,
  kShankRight,
  kShoulder,  // flexion
  kShoulderRight,
  kElbow,
  kElbowRight,
  kShoulderAbduction,
  kShoulderAbductionRight,
  kResidualCount
};
using ResidualAngles = std::array<double, kResidualCount>;  // rad

// Constants of a Markov process.
struct MarkovConstants {
  double rest, time, spread;  // rad, s, rad (the heading has MotionConfig::yaw_rate_sd)
  double lowest, highest;     // rad
  double period = std::numeric_limits<double>::infinity();  // s, period of its oscillation;
                                                            // infinite: none
};

// What a coordinate moves; coordinates that move the same are changed together.
enum class Moves { kTrunk, kLeg, kArm, kWalker };

struct ResidualRow {
  ResidualAngle left, right;  // equal for a single coordinate
  Moves moves;
  bool sideways;            // whether it moves out of the upright plane of the heading
  bool is_deviation;        // whether it is a deviation from an angle that the walker has
  MarkovConstants process;  // of the kneed model, before MotionConfig::residual_scale
  double standing_time;     // s, the time of the process while the subject stands

  constexpr bool paired() const { return left != right; }
  constexpr ResidualAngle of(Side side) const { return side == Side::kLeft ? left : right; }
};

namespace residual_table {

constexpr double deg(double angle) { return rad_from_deg(angle); }
inline constexpr bool kSideways = true, kInPlane = false, kStrays = true, kOwn = false;

}  // namespace residual_table

// All by hand, none fitted. Rests are the mean offsets of walking people from the walker, spreads
// are the differences between people and those along a stride that the walker does not have (walks
// of the development set, 2026-11-21), limits are anatomical. Sensitivity: not measured separately;
// `motion.residual_scale` multiplies the spreads of deviations. A standing person sways and shifts
// weight within seconds, while a walker's residuals change within a tenth of a second.
inline constexpr std::array kResidualTable = [] {
  using namespace residual_table;
  using enum Moves;
  // clang-format off
  return std::array<ResidualRow, 13>{{
    // left, right, moves, plane, is_deviation, {rest, time, spread, lowest, highest}, standing time
    {kHeading, kHeading, kTrunk, kSideways, kOwn, {0, .5, 0, -1e9, 1e9}, .5},
    {kList, kList, kTrunk, kSideways, kOwn, {0, .15, deg(3), deg(-15), deg(15)}, .6},
    {kAbduction, kAbductionRight, kLeg, kSideways, kOwn, {deg(-2.5), .15, deg(3.5), deg(-20), deg(30)}, .6},
    {kRotation, kRotationRight, kLeg, kSideways, kOwn, {deg(-5), .2, deg(6), deg(-40), deg(40)}, .6},
    {kAnkle, kAnkleRight, kLeg, kInPlane, kOwn, {deg(-3), .08, deg(12), deg(-45), deg(30)}, .6},
    {kPace, kPace, kWalker, kInPlane, kOwn, {0, .5, .12, -.4, .4}, .5},
    {kCrouch, kCrouch, kTrunk, kInPlane, kOwn, {deg(8), 3, deg(3), deg(-10), deg(40)}, 3},
    {kTilt, kTilt, kTrunk, kInPlane, kStrays, {0, 1, deg(9), deg(-20), deg(40)}, 1},
    {kThigh, kThighRight, kLeg, kInPlane, kStrays, {0, .15, deg(6), deg(-30), deg(30)}, .4},
    {kShank, kShankRight, kLeg, kInPlane, kStrays, {0, .12, deg(8), deg(-40), deg(40)}, .4},
    {kShoulder, kShoulderRight, kArm, kInPlane, kOwn, {0, .2, deg(15), deg(-60), deg(120)}, .2},
    {kShoulderAbduction, kShoulderAbductionRight, kArm, kSideways, kOwn, {deg(6), .2, deg(6), deg(-10), deg(60)}, .2},
    {kElbow, kElbowRight, kArm, kInPlane, kOwn, {deg(22), .2, deg(15), 0, deg(130)}, .2},
  }};
  // clang-format on
}();

namespace residual_table {

// By ResidualAngle, the number of its row; each has one.
inline constexpr std::array<size_t, kResidualCount> kRows = [] {
  std::array<size_t, kResidualCount> rows;
  rows.fill(kResidualTable.size());
  for (size_t i = 0; i < kResidualTable.size(); ++i)
    rows[kResidualTable[i].left] = rows[kResidualTable[i].right] = i;
  return rows;
}();
static_assert(*std::max_element(kRows.begin(), kRows.end()) < kResidualTable.size());

}  // namespace residual_table

constexpr const ResidualRow& row_of(ResidualAngle angle) {
  return kResidualTable[residual_table::kRows[angle]];
}

// The coordinate of one side, by its left one, or a single coordinate.
constexpr size_t of_side(ResidualAngle left, Side side) { return row_of(left).of(side); }

// Some of the residual angles, in ascending order.
struct ResidualList {
  std::array<ResidualAngle, kResidualCount> at{};
  size_t count = 0;

  constexpr auto begin() const { return at.begin(); }
  constexpr auto end() const { return at.begin() + count; }
  constexpr size_t size() const { return count; }
};

template <typename Wanted>
constexpr ResidualList residuals_where(const Wanted& wanted) {
  ResidualList out;
  for (size_t k = 0; k < kResidualCount; ++k) {
    const auto angle = static_cast<ResidualAngle>(k);
    if (wanted(row_of(angle))) out.at[out.count++] = angle;
  }
  return out;
}

inline constexpr ResidualList kAllResiduals =
    residuals_where([](const ResidualRow&) { return true; });
// The deviations from angles of the walker: of trunk, thighs and shanks.
inline constexpr ResidualList kDeviations =
    residuals_where([](const ResidualRow& row) { return row.is_deviation; });

}  // namespace tracker
}  // namespace walktrack
