#include "tracker/new_step.h"

#include <cmath>

#include <gtest/gtest.h>

#include "body/kinematics.h"
#include "fixture.h"

namespace walktrack {
namespace {

constexpr double kDt = 1.0 / 30;

Rng stream(uint32_t i) { return {5, Purpose::kTorque, 1, i}; }

MotionConfig with_new_steps(double rate) {
  MotionConfig config;
  config.new_steps = rate;
  return config;
}

TEST(NewStep, GoesOnFromThePlaceAtTheSpeed) {
  const Walking walking;
  const MotionContext context = walking.context(kDt, with_new_steps(0));
  for (WalkerParticle& particle : walkers_on_their_way(context, 50)) {
    const Pose was = particle.pose, before = particle.pose_before;
    particle.predicted_extra = particle.extra_before = particle.extra;
    Rng rng = stream(0);
    begin_step_anew(context, particle, rng);
    const Pose now = pose_of(context.model, particle.walker, particle.stance, particle.aim,
                             particle.ball, particle.predicted_extra);
    EXPECT_LT((now.root - was.root - (was.root - before.root)).head<2>().norm(), 1e-9);
    EXPECT_LT((particle.pose_before.root - was.root).head<2>().norm(), 1e-9);
  }
}

// The flow compares the pose with the one before: no joint may move as only a leap would.
TEST(NewStep, TheFrameBeforeBelongsToTheNewStep) {
  const Walking walking;
  const MotionContext context = walking.context(kDt, with_new_steps(0));
  constexpr double kFastestFoot = 7;  // m/s: a swinging foot at 1.7 m/s (1.3 and the aims' spread)
  uint32_t i = 0;
  for (WalkerParticle& particle : walkers_on_their_way(context, 50)) {
    particle.predicted_extra = particle.extra_before = particle.extra;
    Rng rng = stream(i++);
    begin_step_anew(context, particle, rng);
    const Pose now = pose_of(context.model, particle.walker, particle.stance, particle.aim,
                             particle.ball, particle.predicted_extra);
    const auto joints = forward_kinematics(context.model.body, now).joints;
    const auto earlier = forward_kinematics(context.model.body, particle.pose_before).joints;
    for (const Joint joint : {Joint::kLeftKnee, Joint::kLeftAnkle, Joint::kRightAnkle})
      EXPECT_LT((joints[joint] - earlier[joint]).norm(), kFastestFoot * kDt);
  }
}

TEST(NewStep, AsManyAsTheRateSaysAndOnBothFeet) {
  const Walking walking;
  const MotionContext context = walking.context(kDt, with_new_steps(6));
  std::vector<WalkerParticle> set =
      walkers_on_their_way(walking.context(kDt, with_new_steps(0)), 1000);
  int begun = 0, exchanged = 0;
  for (size_t i = 0; i < set.size(); ++i) {
    const Side stood = set[i].stance;
    Rng rng = stream(static_cast<uint32_t>(i));
    ASSERT_EQ(propagate(context, set[i], rng), Outcome::kAlive);
    if (set[i].log_prior == 0) continue;
    EXPECT_EQ(set[i].log_prior, -kNewStepCost);
    ++begun;
    exchanged += set[i].stance != stood;
  }
  EXPECT_NEAR(begun, 200, 4 * std::sqrt(200 * 0.8));  // four standard deviations
  EXPECT_NEAR(exchanged, begun / 2, 4 * std::sqrt(begun * 0.25));
}

TEST(NewStep, TheCostIsOfOneFrame) {
  const Walking walking;
  std::vector<WalkerParticle> set =
      walkers_on_their_way(walking.context(kDt, with_new_steps(0)), 1);
  Rng rng = stream(0);
  propagate(walking.context(kDt, with_new_steps(30)), set[0], rng);
  ASSERT_EQ(set[0].log_prior, -kNewStepCost);
  propagate(walking.context(kDt, with_new_steps(0)), set[0], rng);
  EXPECT_EQ(set[0].log_prior, 0);
}

}  // namespace
}  // namespace walktrack
