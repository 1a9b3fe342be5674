#include "synth/walk/made_walk.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "body/pose_from_joints.h"
#include "core/conventions.h"
#include "core/errors.h"
#include "metrics/gait.h"
#include "walked_curves.h"

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
        // The ball's centre tips over with the sole, by up to 73 degrees.
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
      if (phase < 0.10 || phase > 0.26) continue;  // the sole is flat
      const auto& now = motion.joints[i];
      const auto& before = motion.joints[i - 1];
      EXPECT_LT((now[Joint::kLeftAnkle] - before[Joint::kLeftAnkle]).norm(), 1e-6);
      // The foot leans with the leg about its long axis: a few tenths of a millimetre a row.
      EXPECT_LT((now[Joint::kLeftToe] - before[Joint::kLeftToe]).norm(), 5e-4);
    }
  }
}

TEST(MadeWalk, BendsJointsAsPeopleDo) {
  MadeWalk walk;
  walk.speed = 1.3;
  const WalkedCurves curves = walked_curves(test_body(), walk);
  // Perry & Burnfield 2010: knee 5, 15 to 20 as the leg is loaded (Conventional
  // Gait Model norms: 21), 5, 40 at toe-off, 60.
  EXPECT_NEAR(curves.knee[0], 9, 6);
  const Extreme loaded = most(curves.knee, 5, 30), straight = least(curves.knee, 25, 50);
  EXPECT_NEAR(loaded.value, 20, 3);
  EXPECT_NEAR(static_cast<double>(loaded.at), 15, 4);
  EXPECT_NEAR(straight.value, 9, 4);
  EXPECT_NEAR(static_cast<double>(straight.at), 38, 5);
  EXPECT_NEAR(curves.knee[62], 38, 7);
  const Extreme swung = most(curves.knee, 50, 95), stretched = least(curves.knee, 85, 100);
  EXPECT_NEAR(swung.value, 64, 5);
  EXPECT_NEAR(static_cast<double>(swung.at), 73, 3);
  EXPECT_NEAR(stretched.value, 5, 3);
  // Ankle: -5 at 6 %, 10 at 45 %, -15 at toe-off. Hip: 40 degrees of range, most extended at 50 %.
  EXPECT_NEAR(least(curves.ankle, 0, 15).value, -5, 3);
  EXPECT_NEAR(most(curves.ankle, 20, 55).value, 13, 3);
  EXPECT_NEAR(least(curves.ankle, 50, 80).value, -16, 4);
  EXPECT_NEAR(static_cast<double>(least(curves.ankle, 50, 80).at), 62, 3);
  EXPECT_NEAR(most(curves.hip, 0, 100).value - least(curves.hip, 0, 100).value, 44, 5);
  EXPECT_NEAR(static_cast<double>(least(curves.hip, 30, 70).at), 51, 4);
}

TEST(MadeWalk, TheBodyGoesAsHighAsLegsMakeIt) {
  const Body body = test_body();
  const WalkedCurves curves = walked_curves(body, {});
  const Extreme high = most(curves.height, 0, 100), low = least(curves.height, 0, 100);
  // Hips over the ground, share of the straight leg; 2 to 4 cm of rise (Perry & Burnfield 2010).
  EXPECT_NEAR(0.5 * (high.value + low.value) / leg_length(body.lengths), 0.97, 0.01);
  EXPECT_NEAR(high.value - low.value, 0.03, 0.01);
  EXPECT_NEAR(static_cast<double>(high.at % 50), 28, 6);  // over the supporting leg
}

double made_stance(double speed) {
  MadeWalk walk;
  walk.speed = speed;
  walk.to = 8;
  return gait_from_motion(made_walk(test_body(), walk)).stance_share;
}

TEST(MadeWalk, FeetStandAsLongAsPeoplesAndLongerWhenSlow) {
  const double usual = made_stance(1.3);
  EXPECT_GT(usual, .60);
  EXPECT_LT(usual, .63);  // double support is twice what is over a half: 20 to 26 %
  EXPECT_NEAR(made_stance(0.8) - usual, .02, .012);
  EXPECT_NEAR(made_stance(1.8) - usual, -.02, .012);
}

// Height of the lowest point of the rigid foot, heel or tip.
double lowest_sole(const JointPositions& joints, Side side, const BodyLengths& l) {
  const Eigen::Vector3d ball = joints[toe(side)] - joints[ankle(side)];
  const double pitch = std::atan2(l.ball_height - l.ankle_height, l.ball_forward) -
                       std::atan2(ball.z(), ball.head<2>().norm());
  const double under = joints[ankle(side)].z() - l.ankle_height * std::cos(pitch);
  return under - std::max(-.23 * l.foot * std::sin(pitch), .77 * l.foot * std::sin(pitch));
}

TEST(MadeWalk, SwingingToesPassOneOrTwoCentimetresAboveTheGround) {
  const Body body = test_body();
  for (const double speed : {0.6, 1.0, 1.3, 1.8}) {
    MadeWalk walk;
    walk.speed = speed;
    walk.step_length = 0.40 * body.subject.height * std::pow(speed / 1.25, 0.42);
    const double stride = 2 * *walk.step_length / speed;
    walk.to = stride;
    walk.rate = 200 / stride;
    const Motion motion = made_walk(body, walk);
    double least = 1;
    for (size_t i = 150; i <= 180; ++i)  // from 75 to 90 % of the stride
      least = std::min(least, lowest_sole(motion.joints[i], Side::kLeft, body.lengths));
    EXPECT_GT(least, 0.004) << speed;
    EXPECT_LT(least, 0.025) << speed;
  }
}

// Movements scale with the step relative to the body's size: a child's step is short for an adult.
TEST(MadeWalk, AChildBendsKneesAsAnAdultDoes) {
  Subject child;
  child.height = 1.1;
  MadeWalk walk;
  walk.speed = 1;
  const WalkedCurves curves = walked_curves(make_body(child, {}), walk);
  EXPECT_NEAR(most(curves.knee, 5, 30).value, 17, 3);
  EXPECT_NEAR(most(curves.knee, 50, 95).value, 63, 5);
  EXPECT_NEAR(least(curves.ankle, 50, 80).value, -14, 5);
}

TEST(MadeWalk, PeopleDifferALittle) {
  const Body body = test_body();
  std::vector<double> loaded, swung;
  for (uint64_t person = 1; person <= 30; ++person) {
    MadeWalk walk;
    walk.person = person;
    const WalkedCurves curves = walked_curves(body, walk);
    loaded.push_back(most(curves.knee, 5, 30).value);
    swung.push_back(most(curves.knee, 50, 95).value);
    EXPECT_LT(least(curves.knee, 25, 50).value, loaded.back());
  }
  const auto [loaded_least, loaded_most] = std::minmax_element(loaded.begin(), loaded.end());
  EXPECT_GT(*loaded_least, 8);
  EXPECT_GT(*loaded_most - *loaded_least, 4);
  EXPECT_LT(*loaded_most, 28);
  const auto [swung_least, swung_most] = std::minmax_element(swung.begin(), swung.end());
  EXPECT_GT(*swung_least, 50);
  EXPECT_GT(*swung_most - *swung_least, 4);
  EXPECT_LT(*swung_most, 78);
}

TEST(MadeWalk, APersonWalksTheSameWayEachTimeAndAsIsSaid) {
  MadeWalk walk;
  walk.person = 7;
  walk.lean = 0.2;
  walk.step_width = 0.15;
  const JointPositions joints = made_walk(test_body(), walk).joints.front();
  EXPECT_EQ(made_walk(test_body(), walk).joints.front().at, joints.at);
  EXPECT_NEAR(joints[Joint::kLeftAnkle].y() - joints[Joint::kRightAnkle].y(), 0.15, 0.01);
  const Eigen::Vector3d spine = joints[Joint::kNeck] - joints[Joint::kPelvis];
  EXPECT_NEAR(std::atan2(spine.head<2>().norm(), spine.z()), 0.2, 1e-6);
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
  // A quarter of a circle to the left, up to the lateral motion of 18 mm.
  EXPECT_NEAR(turn.joints.back()[Joint::kPelvis].x(), radius, 0.03);
  EXPECT_NEAR(turn.joints.back()[Joint::kPelvis].y(), radius, 0.03);
  MadeWalk shifted;
  shifted.phase = 0.5;
  const JointPositions a = made_walk(body, {}).joints.front();
  const JointPositions b = made_walk(body, shifted).joints.front();
  // Half a stride later the sides are swapped.
  EXPECT_NEAR(a[Joint::kLeftAnkle].x(), b[Joint::kRightAnkle].x(), 1e-9);
  EXPECT_NEAR(a[Joint::kLeftAnkle].y(), -b[Joint::kRightAnkle].y(), 1e-9);
}

TEST(MadeWalk, RefusesStepsThatLegsCannotTake) {
  MadeWalk walk;
  walk.step_length = 1.6;
  EXPECT_THROW(made_walk(test_body(), walk), InputError);
}

// Places of the ankles along the walk, in order, while the foot is flat.
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
  EXPECT_NEAR(straightest(of_usual), 0.999, 2e-3);
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
