#include "body/moved_feet.h"

#include <limits>

#include <gtest/gtest.h>

#include "body/kinematics.h"
#include "body/motion.h"
#include "body/pose_from_joints.h"

namespace walktrack {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

const Body kBody = make_body({}, {});

JointPositions striding() {
  Pose pose;
  pose.root = {1, 2, 0.9};
  pose.heading = 0.7;
  pose.legs[0] = {0.4, 0.05, 0.1, 0.2, 0.1};
  pose.legs[1] = {-0.2, 0.03, 0, 0.5, -0.1};
  return forward_kinematics(kBody, pose).joints;
}

class MovedFeet : public testing::TestWithParam<Side> {
 protected:
  const Side side = GetParam();
  const JointPositions before = striding();
  JointPositions joints = before;

  double knee_flexion(const JointPositions& of) const {
    return pose_from_joints(of, kBody.lengths)->legs[static_cast<size_t>(side)].knee_flexion;
  }
  void expect_the_rest_untouched() const {
    for (size_t j = 0; j < kJointCountWithoutArms; ++j) {
      const auto joint = static_cast<Joint>(j);
      if (joint == knee(side) || joint == ankle(side) || joint == toe(side)) continue;
      EXPECT_EQ(joints.at[j], before.at[j]) << kJointNames[j];
    }
  }
};

TEST_P(MovedFeet, TurnLegGoesThereWithItsLengthsItsKneeAndItsFootAsTheyWere) {
  const Vector2d by(0.03, -0.05);
  turn_leg(side, by, joints);
  const auto length = [&](const JointPositions& of, Joint a, Joint b) {
    return (of[a] - of[b]).norm();
  };
  EXPECT_TRUE((joints[ankle(side)] - before[ankle(side)]).head<2>().isApprox(by, 1e-12));
  EXPECT_NEAR(length(joints, hip(side), knee(side)), kBody.lengths.thigh, 1e-12);
  EXPECT_NEAR(length(joints, knee(side), ankle(side)), kBody.lengths.shank, 1e-12);
  EXPECT_NEAR(length(joints, hip(side), ankle(side)), length(before, hip(side), ankle(side)),
              1e-12);
  EXPECT_NEAR(knee_flexion(joints), knee_flexion(before), 0.01);
  EXPECT_TRUE((joints[toe(side)] - joints[ankle(side)])
                  .isApprox(before[toe(side)] - before[ankle(side)], 1e-12));
  EXPECT_LT(std::abs(joints[ankle(side)].z() - before[ankle(side)].z()), 0.025);
  expect_the_rest_untouched();
}

TEST_P(MovedFeet, TurnLegLeavesItWhereNothingIsAskedForOrTheLegIsTooShort) {
  for (const Vector2d& by : {Vector2d(0, 0), Vector2d(2, 0)}) {
    turn_leg(side, by, joints);
    EXPECT_EQ(joints[knee(side)], before[knee(side)]);
    EXPECT_EQ(joints[ankle(side)], before[ankle(side)]);
    EXPECT_EQ(joints[toe(side)], before[toe(side)]);
  }
  joints[hip(side)].x() = std::numeric_limits<double>::quiet_NaN();
  turn_leg(side, {0.1, 0}, joints);
  EXPECT_EQ(joints[ankle(side)], before[ankle(side)]);
}

TEST_P(MovedFeet, LiftToePutsItOnTheGroundTheWayItPoints) {
  const Vector3d a = joints[ankle(side)];
  joints[toe(side)] = a + Vector3d(0.06, 0.08, -a.z() - 0.02);
  const double length = (joints[toe(side)] - a).norm();
  lift_toe(side, joints);
  const Vector3d foot = joints[toe(side)] - a;
  EXPECT_EQ(joints[toe(side)].z(), 0);
  EXPECT_NEAR(foot.norm(), length, 1e-12);
  EXPECT_NEAR(foot.x() / foot.y(), 0.75, 1e-12);
  EXPECT_EQ(joints[ankle(side)], a);
  EXPECT_EQ(joints[knee(side)], before[knee(side)]);
  expect_the_rest_untouched();
}

TEST_P(MovedFeet, LiftToeLeavesWhatItCannotMend) {
  const Vector3d a = joints[ankle(side)];
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Vector3d& sole : {Vector3d(0.1, 0, 0.01),    // above the ground
                               Vector3d(0, 0, -0.01),     // points straight down
                               Vector3d(0.1, 0, nan)}) {  // unknown
    joints[toe(side)] = Vector3d(a.x() + sole.x(), a.y() + sole.y(), sole.z());
    const JointPositions asked = joints;
    lift_toe(side, joints);
    EXPECT_EQ(joints[toe(side)].head<2>(), asked[toe(side)].head<2>());
    EXPECT_EQ(joints[ankle(side)], asked[ankle(side)]);
  }
  joints[ankle(side)].z() = -0.01;
  joints[toe(side)] = joints[ankle(side)] + Vector3d(0.1, 0, -0.01);
  const Vector3d sunk = joints[toe(side)];
  lift_toe(side, joints);
  EXPECT_EQ(joints[toe(side)], sunk) << "the whole foot is in the ground";
}

INSTANTIATE_TEST_SUITE_P(Sides, MovedFeet, testing::Values(Side::kLeft, Side::kRight));

}  // namespace
}  // namespace walktrack
