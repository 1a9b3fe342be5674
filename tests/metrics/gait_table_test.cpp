#include "metrics/gait_table.h"

#include <cmath>

#include <gtest/gtest.h>

#include "test_walk.h"

namespace walktrack {
namespace {

// Foot positions are smooth between frames, so that strikes computed from them differ by at most
// this from the true ones (gait_test.cpp measures it), and differences of strikes by much less.
constexpr double kTiming = 0.01;  // s

TEST(GaitTable, RowsOfAMadeWalkAreThatWalk) {
  const TestWalk walk;
  const GaitTable table = gait_table(walk_motion(walk), {}, {});
  ASSERT_GT(table.contacts.size(), 7u);
  size_t strides = 0;
  // At the start both feet are on the ground, so that the first step between strikes ends in the
  // fourth row.
  for (size_t i = 3; i + 3 < table.contacts.size(); ++i) {
    const auto& at = table.contacts[i].at;
    EXPECT_NE(table.contacts[i].side, table.contacts[i - 1].side);
    EXPECT_NEAR(at[kStepLength].value, walk.speed * walk.step_time, 1e-3);
    EXPECT_NEAR(at[kStepWidth].value, walk.step_width, 1e-3);
    EXPECT_NEAR(at[kStepTime].value, walk.step_time, kTiming);
    EXPECT_NEAR(at[kStrideLength].value, 2 * walk.speed * walk.step_time, 1e-3);
    EXPECT_NEAR(at[kStrideTime].value, 2 * walk.step_time, kTiming);
    EXPECT_NEAR(at[kStrideSpeed].value, walk.speed, 0.02);
    EXPECT_NEAR(at[kStanceShare].value + at[kSwingShare].value, 100, 1e-9);
    // Both feet together are on the ground for 2 x stance of a stride, which without flight is one
    // stride plus double support.
    EXPECT_NEAR(at[kDoubleSupportShare].value, 2 * at[kStanceShare].value - 100, 1);
    ++strides;
  }
  EXPECT_GE(strides, 3u);
  EXPECT_NEAR(table.both[kCadence].value, 60 / walk.step_time, 2);
  EXPECT_NEAR(table.both[kSpeed].value, walk.speed, 0.01);
  for (const Banded& each : table.symmetry) EXPECT_NEAR(each.value, 0, 2);
  EXPECT_NEAR(table.both[kStepLengthSd].value, 0, 1e-3);
}

TEST(GaitTable, ContactsCutByTheEndsLackWhatTheyNeed) {
  const GaitTable table = gait_table(walk_motion({}), {}, {});
  EXPECT_TRUE(std::isnan(table.contacts.front().at[kFootStrike].value));
  EXPECT_TRUE(std::isnan(table.contacts.front().at[kStepLength].value));
  EXPECT_TRUE(std::isnan(table.contacts.back().at[kStrideLength].value));
}

// Somebody walks through the picture twice. Between the passes is no stride.
TEST(GaitTable, PassesAreWalksOfTheirOwn) {
  const TestWalk walk{.phase = 0.3};  // the right foot swings at first
  Motion passes = walk_motion(walk);
  const Motion once = passes;
  const auto add_rows = [&](const std::vector<JointPositions>& rows) {
    for (const JointPositions& joints : rows) {
      passes.time.push_back(static_cast<double>(passes.time.size()) / walk.rate);
      passes.joints.push_back(joints);
    }
  };
  add_rows(std::vector<JointPositions>(30, unknown_joints()));
  add_rows(once.joints);
  const GaitTable alone = gait_table(once, {}, {}), both = gait_table(passes, {}, {});
  EXPECT_EQ(both.contacts.size(), 2 * alone.contacts.size());
  EXPECT_EQ(both.strides, 2 * alone.strides);
  EXPECT_NEAR(both.right[kMeanStrideTime].value, alone.right[kMeanStrideTime].value, 1e-9);
  EXPECT_NEAR(both.left[kMeanStance].value, alone.left[kMeanStance].value, 1e-9);
  EXPECT_NEAR(gait_from_motion(passes).stance_share, gait_from_motion(once).stance_share, 1e-9);
}

TEST(GaitTable, ALimpIsAnAsymmetryOfItsSide) {
  // The right foot lands 6 cm short: left steps are 12 cm longer than right ones.
  const TestWalk walk;
  const Motion limping = changed(walk_motion(walk), [](JointPositions& joints, size_t) {
    joints[ankle(Side::kRight)].x() -= 0.06;
    joints[toe(Side::kRight)].x() -= 0.06;
  });
  const GaitTable table = gait_table(limping, {}, {});
  EXPECT_NEAR(table.left[kMeanStepLength].value - table.right[kMeanStepLength].value, 0.12, 5e-3);
  EXPECT_NEAR(table.symmetry[kStepLengthSymmetry].value, 100 * 0.12 / (walk.speed * walk.step_time),
              1);
  const GaitTable mirrored = gait_table(
      changed(limping, [](JointPositions& joints, size_t) { mirror_legs(joints); }), {}, {});
  EXPECT_NEAR(mirrored.symmetry[kStepLengthSymmetry].value,
              -table.symmetry[kStepLengthSymmetry].value, 1e-9);
}

// Members that differ by known amounts have bands of known widths.
TEST(GaitTable, BandsAreTheMembersSpread) {
  std::vector<Motion> members;
  for (const double late : {-0.02, -0.01, 0.0, 0.01, 0.02}) {
    members.push_back(walk_motion({}));
    for (double& time : members.back().time) time += late;
  }
  const GaitTable table = gait_table(walk_motion({}), ensemble_of(members), {});
  const auto& at = table.contacts[3].at;
  // The 5 % point of five numbers 0.01 apart is 0.2 of the way from the first to the second.
  EXPECT_NEAR(at[kFootStrike].p95 - at[kFootStrike].value, 0.018, 1e-6);
  EXPECT_NEAR(at[kFootStrike].value - at[kFootStrike].p05, 0.018, 1e-6);
  EXPECT_NEAR(at[kStepLength].p95 - at[kStepLength].p05, 0, 1e-9);
  EXPECT_NEAR(table.both[kMeanStepTime].p95 - table.both[kMeanStepTime].p05, 0, 1e-9);
}

TEST(GaitTable, WithoutMostMembersThereIsNoBand) {
  const Motion motion = walk_motion({});
  std::vector<Motion> members(5, motion);
  for (size_t m = 0; m < 3; ++m)
    members[m] = changed(motion, [](JointPositions& joints, size_t) { joints = unknown_joints(); });
  const GaitTable table = gait_table(motion, ensemble_of(members), {});
  EXPECT_TRUE(std::isfinite(table.contacts[3].at[kFootStrike].value));
  EXPECT_TRUE(std::isnan(table.contacts[3].at[kFootStrike].p05));
}

// A member in which the walker was lost earlier has other steps, but is not another walker.
TEST(GaitTable, MembersAreComparedOverTheStepsTheySaw) {
  const Motion limping = changed(walk_motion({}), [](JointPositions& joints, size_t) {
    joints[ankle(Side::kRight)].x() -= 0.06;
    joints[toe(Side::kRight)].x() -= 0.06;
  });
  std::vector<Motion> members;
  for (const size_t rows : {60u, 75u, 90u, 105u, 120u, 150u})
    members.push_back(changed(limping, [&](JointPositions& joints, size_t row) {
      if (row >= rows) joints = unknown_joints();
    }));
  const GaitTable table = gait_table(limping, ensemble_of(members), {});
  for (const SummaryColumn k : {kMeanStepLength, kMeanStepWidth, kMeanStrideLength}) {
    // A stance that is shortened by the cut has its place from fewer rows; a foot on the ground
    // does not move, so that it is equal.
    EXPECT_NEAR(table.both[k].p95 - table.both[k].p05, 0, 1e-3) << kSummaryColumns[k];
    EXPECT_TRUE(std::isfinite(table.both[k].p05)) << kSummaryColumns[k];
  }
}

// Times and lengths are positive in every member, and therefore in every band, and each band
// contains its value, however noisy the members are.
TEST(GaitTable, BandsStayAmongWhatMembersShow) {
  std::vector<Motion> members;
  for (size_t m = 0; m < 20; ++m)
    members.push_back(changed(walk_motion({.duration = 2.5}), [&](JointPositions& joints,
                                                                  size_t i) {
      for (size_t j = 0; j < joints.at.size(); ++j)
        joints.at[j].x() += 0.06 * std::sin(double(m * m) + double(i) * (0.5 + 0.1 * double(m)));
    }));
  const GaitTable table = gait_table(walk_motion({.duration = 2.5}), ensemble_of(members), {});
  for (const Summary* summary : {&table.both, &table.left, &table.right}) {
    for (size_t k = 0; k < kSummaryColumnCount; ++k) {
      const Banded& each = (*summary)[k];
      if (std::isnan(each.p05)) continue;
      EXPECT_LE(each.p05, each.value) << kSummaryColumns[k];
      EXPECT_GE(each.p95, each.value) << kSummaryColumns[k];
    }
    EXPECT_GT((*summary)[kCadence].p05, 0);
    EXPECT_LT((*summary)[kCadence].p95, 300);
  }
}

TEST(GaitTable, FewStepsHaveNoSymmetryAndNoSpread) {
  const GaitTable table = gait_table(walk_motion({.duration = 1.6}), {}, {});
  ASSERT_GE(table.steps, 1u);
  ASSERT_LE(table.steps, 2u);
  for (const Banded& each : table.symmetry) EXPECT_TRUE(std::isnan(each.value));
  EXPECT_TRUE(std::isnan(table.both[kStepLengthSd].value));
  EXPECT_TRUE(std::isfinite(table.both[kMeanStepLength].value));
}

TEST(GaitTable, TransfersGoToTheContactOfTheirFoot) {
  const Motion motion = walk_motion({});
  const GaitTable plain = gait_table(motion, {}, {});
  const ContactRow& third = plain.contacts[3];
  const double strike = third.at[kFootStrike].value;
  const std::vector<SupportTransfer> transfers{
      {other(third.side), {strike + 0.01, strike, strike + 0.02}},
      {third.side, {strike + 0.05, strike + 0.04, strike + 0.06}},
      {third.side, {strike + 0.1, strike, strike + 0.2}}};
  const GaitTable table = gait_table(motion, {}, transfers);
  EXPECT_EQ(table.contacts[3].at[kSupportTransfer].value, strike + 0.05);
  EXPECT_TRUE(std::isnan(table.contacts[4].at[kSupportTransfer].value));
}

// The same walk along a circle to the left, which takes every place of the straight one along.
Motion on_circle(const Motion& straight, double radius) {
  return changed(straight, [&](JointPositions& joints, size_t) {
    for (Eigen::Vector3d& joint : joints.at) {
      const double angle = joint.x() / radius, from_middle = radius - joint.y();
      joint.head<2>() << from_middle * std::sin(angle), radius - from_middle * std::cos(angle);
    }
  });
}

TEST(GaitTable, StepsTurnWhereAllOfTheBandDoes) {
  const Motion straight = walk_motion({});
  constexpr double kRadius = 2.5;  // m: 15 degrees a step of 0.66 m
  const auto turning = [&](const std::vector<double>& radii) {
    std::vector<Motion> members;
    for (const double radius : radii) members.push_back(on_circle(straight, radius));
    return gait_table(on_circle(straight, kRadius), ensemble_of(members), {}).turning_steps;
  };
  EXPECT_GE(turning({}), 4u) << "no band: the value counts";
  EXPECT_EQ(turning({2.4, 2.4, 2.5, 2.6, 2.6}), turning({}));
  EXPECT_EQ(turning({1.5, 2, 2.5, 5, 5}), 0u) << "it might be straight";
  EXPECT_EQ(gait_table(straight, {}, {}).turning_steps, 0u);
}

TEST(GaitTable, NobodyHasNoGait) {
  const GaitTable table = gait_table({}, {}, {});
  EXPECT_TRUE(table.contacts.empty());
  EXPECT_EQ(table.steps, 0u);
  EXPECT_TRUE(std::isnan(table.both[kSpeed].value));
}

}  // namespace
}  // namespace walktrack
