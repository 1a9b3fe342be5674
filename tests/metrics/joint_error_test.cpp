#include "metrics/joint_error.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/errors.h"
#include "tests/metrics/test_walk.h"

namespace walktrack {
namespace {

using Eigen::Vector3d;

TEST(JointErrors, VanishForThePerfectEstimate) {
  const Motion truth = walk_motion({});
  const JointErrors e = joint_errors(truth, truth);
  EXPECT_EQ(e.absolute.worst, 0);
  EXPECT_LT(e.procrustes.worst, 1e-12);
  EXPECT_EQ(e.filled_share, 1);
  EXPECT_EQ(e.swapped_share, 0);
  EXPECT_EQ(e.frames, truth.time.size());
  EXPECT_EQ(e.by_joint[static_cast<size_t>(Joint::kLeftWrist)].absolute.count, 0u);
}

TEST(JointErrors, EachKindForgivesItsTransform) {
  const Motion truth = walk_motion({});
  const Motion moved = changed(truth, [](JointPositions& joints, size_t) {
    for (Vector3d& p : joints.at) p += Vector3d(0.03, 0, 0.04);
  });
  const JointErrors shift = joint_errors(truth, moved);
  EXPECT_NEAR(shift.absolute.mean, 0.05, 1e-12);
  EXPECT_NEAR(shift.pelvis_relative.mean, 0, 1e-12);
  EXPECT_NEAR(shift.procrustes.mean, 0, 1e-12);
  const Motion turned = changed(truth, [](JointPositions& joints, size_t) {
    for (Vector3d& p : joints.at) p = 1.1 * (Eigen::AngleAxisd(0.3, Vector3d::UnitY()) * p);
  });
  const JointErrors turn = joint_errors(truth, turned);
  EXPECT_GT(turn.pelvis_relative.mean, 0.02);
  EXPECT_NEAR(turn.procrustes.mean, 0, 1e-12);
}

TEST(JointErrors, OffsetsAreAlongTheWayItsLeftAndUp) {
  const Motion truth = walk_motion({});  // along x
  for (const double turn : {0.0, 2.0}) {
    const Eigen::AngleAxisd turned(turn, Vector3d::UnitZ());
    const Motion way = changed(truth, [&](JointPositions& joints, size_t) {
      for (Vector3d& p : joints.at) p = turned * p;
    });
    const Motion moved = changed(way, [&](JointPositions& joints, size_t) {
      for (Vector3d& p : joints.at) p += turned * Vector3d(-0.04, 0.02, 0.01);
    });
    // The pelvis sways 2 cm about the straight path, so that the direction in a window is wrong by
    // up to 2 degrees.
    EXPECT_LT((joint_errors(way, moved).mean_offset - Vector3d(-0.04, 0.02, 0.01)).norm(), 0.002);
  }
}

TEST(JointErrors, StandingHasNoForwardOffset) {
  const Motion truth = walk_motion({});
  const Motion still = changed(truth, [&](JointPositions& j, size_t) { j = truth.joints[0]; });
  EXPECT_TRUE(joint_errors(still, still).mean_offset.hasNaN());
}

TEST(JointErrors, LegLengthIsRelativeToTheTruth) {
  const Motion truth = walk_motion({});
  const Motion large = changed(truth, [](JointPositions& joints, size_t) {
    for (Vector3d& p : joints.at) p *= 1.02;
  });
  EXPECT_NEAR(joint_errors(truth, truth).leg_length_ratio, 1, 1e-12);
  EXPECT_NEAR(joint_errors(truth, large).leg_length_ratio, 1.02, 1e-12);
}

TEST(JointErrors, OneWrongJointCountsASeventh) {
  const Motion truth = walk_motion({});
  const Motion bad = changed(truth, [](JointPositions& joints, size_t) {
    joints[Joint::kRightKnee].z() += 0.07;
    joints[Joint::kNeck].z() += 1;  // not one of the seven
  });
  const JointErrors e = joint_errors(truth, bad);
  EXPECT_NEAR(e.absolute.mean, 0.01, 1e-12);
  EXPECT_NEAR(e.by_joint[static_cast<size_t>(Joint::kRightKnee)].absolute.mean, 0.07, 1e-12);
  EXPECT_NEAR(e.by_joint[static_cast<size_t>(Joint::kNeck)].absolute.mean, 1, 1e-12);
}

TEST(JointErrors, OfEachJointForgiveTheSameTransforms) {
  const Motion truth = walk_motion({});
  const Motion moved = changed(truth, [](JointPositions& joints, size_t) {
    for (Vector3d& p : joints.at) p = 1.1 * (p + Vector3d(0.03, 0, 0.04));
  });
  const JointErrors errors = joint_errors(truth, moved);
  const auto& toe = errors.by_joint[static_cast<size_t>(Joint::kLeftToe)];
  EXPECT_GT(toe.absolute.mean, 0.05);
  EXPECT_GT(toe.pelvis_relative.mean, 0.08);  // 10 % of some 0.9 m
  EXPECT_NEAR(toe.procrustes.mean, 0, 1e-12);
}

TEST(JointErrors, OverTimeAreTheFramesErrorsWithHoles) {
  const Motion truth = walk_motion({});
  const Motion bad = changed(truth, [](JointPositions& joints, size_t i) {
    if (i < 3 || i == 10) joints = unknown_joints();
    for (Vector3d& p : joints.at) p.x() += i == 20 ? 0.05 : 0.01;
  });
  const JointErrors e = joint_errors(truth, bad);
  ASSERT_EQ(e.by_frame.size(), truth.time.size() - 3);
  ASSERT_EQ(e.time.size(), e.by_frame.size());
  EXPECT_EQ(e.time.front(), truth.time[3]);
  EXPECT_TRUE(std::isnan(e.by_frame[7]));
  EXPECT_NEAR(e.by_frame[17], 0.05, 1e-12);
  EXPECT_NEAR(e.by_frame[18], 0.01, 1e-12);
}

TEST(JointErrors, SwappedLegsAreSwappedWhereTheFeetAreApart) {
  const Motion truth = walk_motion({});
  const Motion bad = changed(truth, [](JointPositions& joints, size_t) { mirror_legs(joints); });
  size_t apart = 0;
  for (const JointPositions& joints : truth.joints)
    apart += (joints[Joint::kLeftAnkle] - joints[Joint::kRightAnkle]).norm() > 0.25;
  const JointErrors e = joint_errors(truth, bad);
  EXPECT_GT(apart, truth.time.size() / 2);
  EXPECT_NEAR(e.swapped_share, double(apart) / double(truth.time.size()), 1e-12);
}

TEST(JointErrors, ScoringStartsAtTheFirstFilledFrameAndCountsGaps) {
  const Motion truth = walk_motion({});
  const Motion sparse = changed(truth, [](JointPositions& joints, size_t i) {
    if (i < 10 || i == 50) joints[Joint::kLeftKnee].x() = std::nan("");
    if (i == 60) joints = unknown_joints();
  });
  const JointErrors e = joint_errors(truth, sparse);
  EXPECT_DOUBLE_EQ(e.start, truth.time[10]);
  EXPECT_EQ(e.frames, truth.time.size() - 10);
  EXPECT_NEAR(e.filled_share, 1 - 2.0 / double(e.frames), 1e-12);
  Motion dropped = sparse;  // a missing row is a gap like an empty one
  dropped.time.erase(dropped.time.begin() + 60);
  dropped.joints.erase(dropped.joints.begin() + 60);
  EXPECT_EQ(joint_errors(truth, dropped).filled_share, e.filled_share);
}

TEST(JointErrors, AnEstimateAtAnotherRateIsInterpolated) {
  TestWalk walk;
  walk.rate = 60;
  const Motion truth = walk_motion(walk);
  walk.rate = 30;
  const JointErrors e = joint_errors(truth, walk_motion(walk));
  EXPECT_GT(e.filled_share, 0.99);
  // Swing accelerates at up to 30 m/s^2; h^2 a / 8 of a linear rule would give 4 mm at the ankles.
  EXPECT_LT(e.absolute.worst, 0.002);
}

TEST(JointErrors, NothingTrackedIsNotAnErrorButNoTruthIs) {
  const Motion truth = walk_motion({});
  const Motion lost =
      changed(truth, [](JointPositions& joints, size_t) { joints = unknown_joints(); });
  EXPECT_EQ(joint_errors(truth, lost).filled_share, 0);
  EXPECT_EQ(joint_errors(truth, lost).frames, 0u);
  EXPECT_THROW(joint_errors(lost, truth), InputError);
}

}  // namespace
}  // namespace walktrack
