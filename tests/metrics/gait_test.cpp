#include "metrics/gait.h"

#include <gtest/gtest.h>

#include "core/conventions.h"
#include "tests/metrics/test_walk.h"

namespace walktrack {
namespace {

// An ankle is furthest in front of the pelvis when it has slowed down to the pelvis's speed, 6 u (1
// - u) / (1 - stance) = 1, i.e. 7.2 % of the swing or 32 ms before it is on the ground; the strike
// is detected 3.8 % of the stride or 42 ms later, 10 ms late; toe-offs are detected 29 ms after the
// toe left: it has half of its highest speed after 64 ms (6 u (1 - u) = 3/4), and the pelvis has
// .27 of that speed.
constexpr double kLateStrike = 0.015, kLate = 0.025;

TEST(Gait, ReadsTheNumbersThatTheWalkWasMadeOf) {
  for (const double heading : {0.0, 1.0, -2.5, kPi}) {
    TestWalk walk;
    walk.heading = heading;
    const Gait gait = gait_from_motion(walk_motion(walk));
    EXPECT_NEAR(gait.speed, walk.speed, 1e-3);
    EXPECT_NEAR(gait.mean_step_length, walk.speed * walk.step_time, 1e-3);
    EXPECT_NEAR(gait.mean_step_time, walk.step_time, 1e-2);
    EXPECT_NEAR(gait.mean_step_width, walk.step_width, 1e-3);
    // Strikes and toe-offs come late.
    EXPECT_NEAR(gait.stance_share, walk.stance_share, kLate / (2 * walk.step_time));
    EXPECT_GE(gait.steps.size(), 7u);
  }
}

TEST(Gait, PutsTheStrikesOfEachFootInTime) {
  const TestWalk walk;
  const Gait gait = gait_from_motion(walk_motion(walk));
  size_t strikes = 0;
  for (const GaitEvent& event : gait.events) {
    if (event.kind != GaitEventKind::kFootStrike) continue;
    const double offset = event.side == Side::kLeft ? 0 : walk.step_time;
    const double error = std::remainder(event.time - offset, 2 * walk.step_time);
    EXPECT_LE(error, kLateStrike);
    EXPECT_GE(error, 0.002);
    ++strikes;
  }
  EXPECT_GE(strikes, 7u);
  for (size_t i = 1; i < gait.stances.size(); ++i)
    EXPECT_NE(gait.stances[i].side, gait.stances[i - 1].side);
}

// A foot that is moving, or partly off the ground, at the video's beginning has no place yet.
TEST(Gait, AStepNeedsBothStrikes) {
  for (const double phase : {0.05, 0.2, 0.35, 0.45, 0.55, 0.8}) {
    const TestWalk walk{.phase = phase};
    const Motion motion = changed(walk_motion(walk), [](JointPositions& joints, size_t i) {
      for (const Side side : {Side::kLeft, Side::kRight})  // still changing
        for (const Joint joint : {ankle(side), toe(side)}) joints[joint].x() -= i < 12 ? 0.4 : 0;
    });
    const Gait gait = gait_from_motion(motion);
    ASSERT_FALSE(gait.steps.empty());
    for (const Step& step : gait.steps) {
      EXPECT_TRUE(gait.stances[step.from].starts_in_motion);
      EXPECT_TRUE(gait.stances[step.to].starts_in_motion);
    }
  }
}

TEST(Gait, SwappedSidesSwapTheEvents) {
  const Motion motion = walk_motion({});
  const Gait gait = gait_from_motion(motion);
  const Gait mirrored = gait_from_motion(
      changed(motion, [](JointPositions& joints, size_t) { mirror_legs(joints); }));
  ASSERT_EQ(gait.events.size(), mirrored.events.size());
  for (size_t i = 0; i < gait.events.size(); ++i) {
    EXPECT_EQ(gait.events[i].time, mirrored.events[i].time);
    EXPECT_EQ(gait.events[i].side, other(mirrored.events[i].side));
  }
}

TEST(Gait, StandingAndSwayingIsNoGait) {
  const Motion standing = changed(walk_motion({}), [](JointPositions& joints, size_t i) {
    joints = walk_joints({}, 0.2);
    joints[Joint::kPelvis].x() += 0.05 * std::sin(0.2 * double(i));
  });
  const Gait gait = gait_from_motion(standing);
  EXPECT_TRUE(gait.events.empty());
  EXPECT_TRUE(gait.stances.empty());
  EXPECT_LT(gait.speed, 0.2);
  EXPECT_TRUE(gait.steps.empty());
}

// Two seconds of standing before the walk and two after it change neither its speed nor its steps.
TEST(Gait, StandingBeforeAndAfterIsNoPartOfTheWalk) {
  constexpr double kStands = 2;  // s
  const Motion walk = walk_motion({});
  const double dt = sample_period(walk);
  const auto rows = static_cast<size_t>(kStands / dt);
  Motion motion;
  motion.joints.assign(rows, walk.joints.front());
  motion.joints.insert(motion.joints.end(), walk.joints.begin(), walk.joints.end());
  motion.joints.insert(motion.joints.end(), rows, walk.joints.back());
  for (size_t i = 0; i < motion.joints.size(); ++i) motion.time.push_back(dt * double(i));
  const Gait alone = gait_from_motion(walk), whole = gait_from_motion(motion);
  EXPECT_NEAR(whole.speed, alone.speed, 0.15 * alone.speed);  // the path is smoothed over the ends
  EXPECT_NEAR(whole.mean_step_length, alone.mean_step_length, 0.02);
  EXPECT_NEAR(whole.mean_step_time, alone.mean_step_time,
              0.05);  // frozen in mid-step at either end
  for (const GaitEvent& event : whole.events) {
    EXPECT_GT(event.time, kStands - 0.5);
    EXPECT_LT(event.time, motion.time.back() - kStands + 0.5);
  }
}

TEST(Gait, AnEmptyOrUnknownMotionHasNone) {
  EXPECT_EQ(gait_from_motion({}).speed, 0);
  const Motion lost =
      changed(walk_motion({}), [](JointPositions& joints, size_t) { joints = unknown_joints(); });
  EXPECT_TRUE(gait_from_motion(lost).events.empty());
}

TEST(EventErrors, FindDelayMissedAndExtraEvents) {
  const std::vector<GaitEvent> truth = gait_from_motion(walk_motion({})).events;
  std::vector<GaitEvent> late = truth;
  for (GaitEvent& event : late) event.time += 0.033;
  const EventErrors delay = event_errors(truth, late);
  EXPECT_EQ(delay.matched, truth.size());
  EXPECT_NEAR(delay.mean_late, 0.033, 1e-12);
  late.front().time += 0.4;  // outside any match: one missed and one additional
  late.pop_back();           // and one missed
  const EventErrors some = event_errors(truth, late);
  EXPECT_EQ(some.missed, 2u);
  EXPECT_EQ(some.extra, 1u);
}

}  // namespace
}  // namespace walktrack
