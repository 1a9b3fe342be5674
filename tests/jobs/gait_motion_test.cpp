#include "jobs/render/gait_motion.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "body/body.h"
#include "core/conventions.h"
#include "core/errors.h"
#include "jobs/track/results/motion_tables.h"
#include "kinetics/force_error.h"
#include "kinetics/gait_contacts.h"
#include "metrics/gait.h"

namespace walktrack {
namespace {

using Eigen::Vector3d;

constexpr double kWeight = 70 * kStandardGravity;  // N, of the default subject

std::vector<double> frame_times(double rate, double duration) {
  std::vector<double> out;
  for (int i = 0; i <= static_cast<int>(duration * rate); ++i) out.push_back(i / rate);
  return out;
}

const WalkedGait& usual_walk() {
  static const WalkedGait walk = walked_gait(
      {.plan = {.speed = 1.3, .changes = {}}, .start = {2, -1}, .heading = 0.5}, Subject{}, 0, 4);
  return walk;
}

// The state at a row's time is interpolated from a simulation in steps of a millisecond.
TEST(GaitMotion, ForcesAndWeightAccountForAllMomentum) {
  constexpr double kRate = 120;
  const Kinetics truth = ground_kinetics(usual_walk(), frame_times(kRate, 4), 1 / kRate);
  const auto& frames = truth.frames;
  // From the first interval on: velocity + sum of (force / mass + gravity) dt = velocity later.
  Vector3d velocity = (frames[1].com - frames[0].com) * kRate;
  double worst = 0;
  for (size_t i = 1; i + 1 < frames.size(); ++i) {
    velocity += (frames[i].ground.force / 70 - Vector3d(0, 0, kStandardGravity)) / kRate;
    const Vector3d moved = (frames[i + 1].com - frames[i].com) * kRate;
    // A strike changes the velocity by 0.6 m/s anywhere within an interval, and the centre of mass
    // is that of the millisecond before: 1.3 m/s * 1 ms * 120 Hz.
    ASSERT_LT((moved - velocity).norm(), 0.8) << truth.time[i];
    worst = std::max(worst, (moved - velocity).norm());
  }
  EXPECT_LT((velocity - (frames.back().com - frames[frames.size() - 2].com) * kRate).norm(), 0.2)
      << "the sum drifts over eight steps";
  EXPECT_GT(worst, 0.01) << "a comparison of two things that are one";
}

TEST(GaitMotion, TheGroundCarriesTheWeightOverStridesAndPushesUpAlways) {
  const Kinetics truth = ground_kinetics(usual_walk(), frame_times(30, 4), 1 / 30.0);
  const Gait gait = gait_from_motion(usual_walk().motion);
  std::vector<double> strikes;
  for (const GaitEvent& event : gait.events)
    if (event.side == Side::kLeft && event.kind == GaitEventKind::kFootStrike)
      strikes.push_back(event.time);
  ASSERT_GE(strikes.size(), 3u);
  double sum = 0;
  int count = 0;
  for (size_t i = 0; i < truth.frames.size(); ++i) {
    for (const FootLoad& foot : truth.frames[i].feet) EXPECT_GE(foot.force.z(), -1e-6);
    if (truth.time[i] < strikes.front() || truth.time[i] >= strikes.back()) continue;
    sum += truth.frames[i].ground.force.z();
    ++count;
  }
  // One row more or less at the ends, which may contain a strike of 2 kN.
  EXPECT_NEAR(sum / count, kWeight, 2000.0 / count);
}

TEST(GaitMotion, FeetStandWhereTheGroundPushes) {
  const WalkedGait& walk = usual_walk();
  const double foot = make_body(Subject{}, {}).lengths.foot;
  const Kinetics truth = ground_kinetics(walk, walk.motion.time, 1 / 240.0);
  const Vector3d ahead(std::cos(0.5), std::sin(0.5), 0);
  int standing = 0;
  for (size_t i = 0; i < truth.frames.size(); ++i) {
    for (const Side side : {Side::kLeft, Side::kRight}) {
      const FootLoad& load = truth.frames[i].feet[static_cast<size_t>(side)];
      if (!load.centre.allFinite()) continue;
      const Vector3d ankle_place = walk.motion.joints[i][ankle(side)];
      const Vector3d toe_place = walk.motion.joints[i][toe(side)];
      const Eigen::Vector2d from_ankle = load.centre - ankle_place.head<2>();
      // From the heel to the toes, and not beside the foot.
      EXPECT_GT(from_ankle.dot(ahead.head<2>()), -0.3 * foot);
      EXPECT_LT(from_ankle.dot(ahead.head<2>()), 0.8 * foot);
      EXPECT_NEAR(ahead.x() * from_ankle.y() - ahead.y() * from_ankle.x(), 0, 1e-9);
      // The feet are on the ground: the ball is at the height of the sole.
      EXPECT_NEAR(toe_place.z(), make_body(Subject{}, {}).lengths.ball_height, 0.01);
      ++standing;
    }
  }
  EXPECT_EQ(standing, static_cast<int>(truth.frames.size()));  // always exactly one
}

TEST(GaitMotion, StandsWhereAskedAndWalksThatWayAtThatSpeed) {
  const Motion& motion = usual_walk().motion;
  const auto row = [&](double time) {
    return motion.joints[static_cast<size_t>(std::lround((time - motion.time.front()) * 240))];
  };
  EXPECT_LT((row(0)[Joint::kPelvis].head<2>() - Eigen::Vector2d(2, -1)).norm(), 1e-9);
  const Vector3d way = row(4)[Joint::kPelvis] - row(0)[Joint::kPelvis];
  EXPECT_NEAR(std::atan2(way.y(), way.x()), 0.5, 1e-9);
  EXPECT_NEAR(way.norm() / 4, 1.3, 0.05 * 1.3);  // between nodes of the table
  EXPECT_LT(motion.time.front(), -0.2);
  EXPECT_GT(motion.time.back(), 4.2);
}

// Independent forces: from the joints alone, by inverse dynamics of another body model. Both have
// the same mass; its distribution differs.
TEST(GaitMotion, InverseDynamicsOfTheJointsFindsTheForces) {
  const WalkedGait& walk = usual_walk();
  const auto contacts = foot_contacts(gait_from_motion(walk.motion));
  const Kinetics found =
      kinetics_of(walk.motion, contacts, Subject{}, {0, 0, -kStandardGravity}, KineticsConfig{});
  const Kinetics truth = ground_kinetics(walk, walk.motion.time, 1 / 240.0);
  const auto forces = [](const Kinetics& of) {
    GroundForces out{of.time, {}};
    for (const KineticsFrame& frame : of.frames)
      out.feet.push_back({frame.feet[0].force, frame.feet[1].force});
    return out;
  };
  const ForceErrors e = force_errors(forces(truth), forces(found), 6);
  EXPECT_GT(e.count, 900u);
  EXPECT_LT(e.vertical_rms, 0.08 * kWeight);
  EXPECT_LT(e.horizontal_rms, 0.05 * kWeight);
}

TEST(GaitMotion, WalksDownhillBrakedByNothingButTheGround) {
  const WalkedGait walk = walked_gait({.plan = {.speed = 1.2, .changes = {}}}, Subject{}, 0.05, 3);
  const Kinetics truth = ground_kinetics(walk, frame_times(30, 3), 1 / 30.0);
  Vector3d sum = Vector3d::Zero();
  for (const KineticsFrame& frame : truth.frames) sum += frame.ground.force;
  // At a steady speed the ground compensates gravity along the slope.
  EXPECT_NEAR(sum.x() / sum.z(), -std::tan(0.05), 0.02);
}

TEST(GaitMotion, AWalkerThatFallsIsReported) {
  EXPECT_THROW(
      walked_gait({.plan = {.speed = 1.8, .changes = {}, .feedback = -3}}, Subject{}, 0, 20),
      InputError);
}

}  // namespace
}  // namespace walktrack
