#include "synth/made_walk.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "body/pose_from_joints.h"
#include "core/conventions.h"
#include "core/errors.h"

namespace walktrack {
namespace {

Body test_body() { return make_body(Subject{}, {.head = true, .arms = true}); }

double bone(const JointPositions& joints, Joint a, Joint b) {
  return (joints[a] - joints[b]).norm();
}

TEST(MadeWalk, KeepsBonesGroundAndSpeedAtEverySpeed) {
  const Body body = test_body();
  for (const double speed : {0.5, 1.0, 1.25, 1.8, 2.1}) {
    MadeWalk walk;
    walk.speed = speed;
    const Motion motion = made_walk(body, walk);
    ASSERT_EQ(motion.time.size(), 481u);
    for (const JointPositions& joints : motion.joints) {
      for (const Side side : {Side::kLeft, Side::kRight}) {
        EXPECT_NEAR(bone(joints, hip(side), knee(side)), body.lengths.thigh, 1e-9);
        EXPECT_NEAR(bone(joints, knee(side), ankle(side)), body.lengths.shank, 1e-9);
        // The ball's centre tips over with the sole, by up to 67 degrees.
        EXPECT_GT(joints[toe(side)].z(), 0.35 * body.lengths.ball_height);
      }
    }
    const double way =
        (motion.joints.back()[Joint::kPelvis] - motion.joints.front()[Joint::kPelvis])
            .head<2>()
            .norm();
    EXPECT_NEAR(way / walk.to, speed, 0.012);  // sway 18 mm at either end
  }
}

TEST(MadeWalk, StandingFeetStand) {
  const Body body = test_body();
  for (const double turn_rate : {0.0, 0.5}) {
    MadeWalk walk;
    walk.turn_rate = turn_rate;
    const Motion motion = made_walk(body, walk);
    const double stride = 2 * 0.40 * body.subject.height / walk.speed;
    for (size_t i = 1; i < motion.time.size(); ++i) {
      const double phase = motion.time[i] / stride - std::floor(motion.time[i] / stride);
      if (phase < 0.11 || phase > 0.34) continue;  // the sole is flat
      const auto& now = motion.joints[i];
      const auto& before = motion.joints[i - 1];
      EXPECT_LT((now[Joint::kLeftAnkle] - before[Joint::kLeftAnkle]).norm(), 1e-6);
      // The foot leans with the leg about its long axis: a few tenths of a millimetre a row.
      EXPECT_LT((now[Joint::kLeftToe] - before[Joint::kLeftToe]).norm(), 5e-4);
    }
  }
}

TEST(MadeWalk, BendsKneesAsPeopleDo) {
  const Body body = test_body();
  double most = 0, least = 1;
  for (const JointPositions& joints : made_walk(body, {}).joints) {
    const auto pose = pose_from_joints(joints, body.lengths);
    ASSERT_TRUE(pose.has_value());
    most = std::max(most, pose->legs[0].knee_flexion);
    least = std::min(least, pose->legs[0].knee_flexion);
  }
  EXPECT_GT(deg_from_rad(most), 45);  // Perry: 60 degrees in swing
  EXPECT_LT(deg_from_rad(most), 75);
  EXPECT_GT(least, 0);
  EXPECT_LT(deg_from_rad(least), 25);
}

TEST(MadeWalk, MovesSmoothly) {
  const Motion motion = made_walk(test_body(), {});
  for (size_t i = 2; i < motion.time.size(); ++i) {
    for (size_t j = 0; j < kJointCount; ++j) {
      const Eigen::Vector3d bend =
          motion.joints[i].at[j] - 2 * motion.joints[i - 1].at[j] + motion.joints[i - 2].at[j];
      // Feet of people reach some 60 m/s^2 at the strike; a jump of a centimetre would be 144.
      EXPECT_LT(bend.norm() * 120 * 120, 100) << kJointNames[j] << " at " << motion.time[i];
    }
  }
}

TEST(MadeWalk, FollowsItsPathAndPhase) {
  const Body body = test_body();
  MadeWalk walk;
  walk.turn_rate = 0.4;
  walk.to = kPi / 2 / 0.4;
  const Motion turn = made_walk(body, walk);
  const double radius = walk.speed / walk.turn_rate;
  // A quarter of a circle to the left, up to the sway of 18 mm.
  EXPECT_NEAR(turn.joints.back()[Joint::kPelvis].x(), radius, 0.03);
  EXPECT_NEAR(turn.joints.back()[Joint::kPelvis].y(), radius, 0.03);
  MadeWalk shifted;
  shifted.phase = 0.5;
  const JointPositions a = made_walk(body, {}).joints.front();
  const JointPositions b = made_walk(body, shifted).joints.front();
  // Half a stride later the sides have changed places.
  EXPECT_NEAR(a[Joint::kLeftAnkle].x(), b[Joint::kRightAnkle].x(), 1e-9);
  EXPECT_NEAR(a[Joint::kLeftAnkle].y(), -b[Joint::kRightAnkle].y(), 1e-9);
}

TEST(MadeWalk, RefusesStepsThatLegsCannotTake) {
  MadeWalk walk;
  walk.step_length = 1.6;
  EXPECT_THROW(made_walk(test_body(), walk), InputError);
}

// Landing places of the ankles along the way, in order: where the foot is flat.
std::vector<double> landings(const Motion& motion) {
  std::vector<double> out;
  for (const Side side : {Side::kLeft, Side::kRight}) {
    double last = -1e9;
    for (size_t i = 1; i < motion.joints.size(); ++i) {
      const double x = motion.joints[i][ankle(side)].x();
      if (std::abs(x - motion.joints[i - 1][ankle(side)].x()) > 1e-7 || x - last < 0.1) continue;
      out.push_back(last = x);
    }
  }
  std::sort(out.begin(), out.end());
  return out;
}

TEST(MadeWalk, ALimpMakesEveryOtherStepLonger) {
  MadeWalk walk;
  walk.speed = 0.8;
  walk.step_length = 0.5;
  walk.limp = 0.2;
  const std::vector<double> places = landings(made_walk(test_body(), walk));
  ASSERT_GE(places.size(), 4u);
  for (size_t i = 2; i < places.size(); ++i) {
    EXPECT_NEAR(places[i] - places[i - 2], 1.0, 1e-6);
    const double step = places[i] - places[i - 1];
    EXPECT_NEAR(std::abs(step - 0.5), 0.1, 1e-6);
  }
}

TEST(MadeWalk, PatientsStandAsWideLeanAndCrouchAsIsSaid) {
  const Body body = test_body();
  MadeWalk usual, patient;
  usual.speed = patient.speed = 0.7;
  patient.step_width = 0.2;
  patient.lean = 0.3;
  patient.straightest = 0.93;
  const auto straightest = [&](const Motion& motion) {
    double most = 0;
    for (const JointPositions& joints : motion.joints)
      for (const Side side : {Side::kLeft, Side::kRight})
        most = std::max(most, bone(joints, hip(side), ankle(side)));
    return most / (body.lengths.thigh + body.lengths.shank);
  };
  const Motion of_usual = made_walk(body, usual), of_patient = made_walk(body, patient);
  EXPECT_NEAR(straightest(of_usual), 0.985, 2e-3);
  EXPECT_NEAR(straightest(of_patient), 0.93, 2e-3);
  for (const JointPositions& joints : of_patient.joints) {
    const Eigen::Vector3d spine = joints[Joint::kNeck] - joints[Joint::kPelvis];
    EXPECT_NEAR(std::atan2(spine.x(), spine.z()), 0.3, 0.1);
  }
  const auto width = [](const Motion& motion) {
    double most = 0;
    for (const JointPositions& joints : motion.joints)
      most = std::max(most, joints[Joint::kLeftAnkle].y() - joints[Joint::kRightAnkle].y());
    return most;
  };
  EXPECT_NEAR(width(of_patient) - width(of_usual), 0.11, 0.02);
}

}  // namespace
}  // namespace walktrack
