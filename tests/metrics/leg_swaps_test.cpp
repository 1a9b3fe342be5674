#include "metrics/leg_swaps.h"

#include <cmath>
#include <numbers>
#include <utility>

#include <gtest/gtest.h>

namespace walktrack {
namespace {

// Feet swinging past each other, hip-width apart, at 30 Hz.
Motion walk(int rows) {
  Motion motion;
  for (int i = 0; i < rows; ++i) {
    motion.time.push_back(i / 30.0);
    JointPositions joints = unknown_joints();
    for (const Side side : {Side::kLeft, Side::kRight}) {
      const double sign = side == Side::kLeft ? 1 : -1;
      const double swing = sign * std::sin(2 * std::numbers::pi * i / 33.0);
      const double x = 1.3 * i / 30.0;
      joints[knee(side)] = {x + 0.2 * swing, 0.08 * sign, 0.5};
      joints[ankle(side)] = {x + 0.35 * swing, 0.08 * sign, 0.1};
    }
    motion.joints.push_back(joints);
  }
  return motion;
}

void swap_legs_from(size_t row, Motion& motion) {
  for (size_t i = row; i < motion.joints.size(); ++i) {
    std::swap(motion.joints[i][Joint::kLeftKnee], motion.joints[i][Joint::kRightKnee]);
    std::swap(motion.joints[i][Joint::kLeftAnkle], motion.joints[i][Joint::kRightAnkle]);
  }
}

TEST(LegSwaps, WalkingHasNone) {
  EXPECT_EQ(leg_swaps(walk(100)), 0u);
  EXPECT_EQ(leg_swaps(Motion{}), 0u);
}

TEST(LegSwaps, CountsEverySwapOfSpreadLegs) {
  Motion motion = walk(100);
  swap_legs_from(40, motion);
  EXPECT_EQ(leg_swaps(motion), 1u);
  swap_legs_from(74, motion);
  EXPECT_EQ(leg_swaps(motion), 2u);
}

TEST(LegSwaps, AGapIsNoSwap) {
  Motion motion = walk(100);
  swap_legs_from(40, motion);
  motion.joints[39] = motion.joints[40] = unknown_joints();
  EXPECT_EQ(leg_swaps(motion), 0u);
}

}  // namespace
}  // namespace walktrack
