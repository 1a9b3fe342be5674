#include "tracker/motion/standing.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "fixture.h"
#include "tests/tracker/frame_time.h"

namespace walktrack {
namespace {

struct Crowd {
  explicit Crowd(int count, const MotionConfig& config = {})
      : process(standing_process(*walking.moves, config, kDt)),
        context(walking.context(kDt, config)) {
    context.standing = &process;
    set = walkers_on_their_way(walking.context(kDt, config), count);
  }

  void frame(uint32_t number) {
    for (size_t i = 0; i < set.size(); ++i) {
      Rng rng(9, Purpose::kTorque, number, static_cast<uint32_t>(i));
      ASSERT_NE(propagate(context, set[i], rng), Outcome::kDead);
    }
  }
  int standing() const {
    return static_cast<int>(std::count_if(set.begin(), set.end(), [](const WalkerParticle& p) {
      return p.regime == Regime::kStanding;
    }));
  }

  Walking walking;
  StandingProcess process;
  MotionContext context;
  std::vector<WalkerParticle> set;
};

// All walkers of the crowd stop.
void halt(Crowd& crowd) {
  for (WalkerParticle& p : crowd.set) {
    const Pose pose = p.pose;
    stand(p);
    for (int k = kHeading; k < kShoulder; ++k)
      p.residual[static_cast<size_t>(k)] = crowd.context.markov[static_cast<size_t>(k)].rest;
    p.residual[kCrouch] = 0;
    p.residual_before = p.residual;
    stand_under(crowd.walking.model, pose, p);
  }
}

TEST(Standing, StandingWalkersDoNotMove) {
  Crowd crowd(300);
  halt(crowd);
  crowd.frame(0);
  const std::vector<WalkerParticle> before = crowd.set;
  for (uint32_t i = 1; i <= 30; ++i) crowd.frame(i);
  const double leg = leg_length(crowd.walking.model.body.lengths);
  double moved = 0, sunk = 0;
  int stood = 0;
  for (size_t i = 0; i < crowd.set.size(); ++i) {
    const WalkerParticle& p = crowd.set[i];
    if (p.regime != Regime::kStanding) continue;
    ++stood;
    moved += (p.ball - before[i].ball).squaredNorm();
    sunk += p.pose.root.z() / leg;
  }
  // Within a second most of those that start to walk once per second have done so, and some have
  // returned.
  ASSERT_GT(stood, 50);
  EXPECT_LT(std::sqrt(moved / stood), 0.03);
  EXPECT_GT(sunk / stood, 0.96);
}

TEST(Standing, RegimesChangeAndPosesStay) {
  Crowd crowd(400);
  halt(crowd);
  const StepLibrary steps(crowd.walking.model, crowd.walking.prior);
  int set_off = 0, stopped = 0, left = 0;
  for (uint32_t i = 0; i < crowd.set.size(); ++i) {
    WalkerParticle p = crowd.set[i];
    crowd.context.moves.apply_noise(crowd.context, p);
    const Pose before = p.pose;
    Rng rng(3, Purpose::kTorque, 1, i);
    for (int attempt = 0; attempt < 3000 && p.regime == Regime::kStanding; ++attempt)
      change_regime(crowd.context, steps, p, rng);
    if (p.regime == Regime::kStanding) continue;
    ++set_off;
    left += p.stance == Side::kLeft;
    const Pose shown = pose_of(crowd.walking.model, p.walker, p.stance, p.aim, p.ball, p.residual);
    for (size_t leg = 0; leg < 2; ++leg) {
      EXPECT_NEAR(shown.legs[leg].hip_flexion, before.legs[leg].hip_flexion, 1e-9);
      EXPECT_NEAR(shown.legs[leg].knee_flexion, before.legs[leg].knee_flexion, 1e-9);
    }
    EXPECT_LT((shown.root - before.root).head<2>().norm(), 1e-9);
    for (int attempt = 0; attempt < 9000 && p.regime == Regime::kWalking; ++attempt)
      change_regime(crowd.context, steps, p, rng);
    stopped += p.regime == Regime::kStanding;
  }
  EXPECT_EQ(set_off, 400);
  EXPECT_GT(stopped, 50);      // standing explains a standing pose better than a step does
  EXPECT_NEAR(left, 200, 60);  // either leg goes first
}

TEST(Standing, AllSetOffTogetherWhenTold) {
  Crowd crowd(300);
  halt(crowd);
  crowd.frame(0);
  EXPECT_GT(crowd.standing(), 250);
  crowd.context.all_set_off = true;
  crowd.frame(1);
  EXPECT_LT(crowd.standing(), 30);
}

// Standing does not explain any pose of a stride as well as walking, so that walks are not
// interrupted.
TEST(Standing, WalkersKeepWalking) {
  Crowd crowd(300);
  for (uint32_t i = 0; i < 12; ++i) crowd.frame(i);
  EXPECT_LE(crowd.standing(), 3);
}

TEST(Standing, WithoutTheRegimeNobodyStands) {
  Walking walking;
  auto set = walkers_on_their_way(walking.context(kDt), 200);
  const MotionContext context = walking.context(kDt);
  for (uint32_t frame = 0; frame < 20; ++frame)
    for (size_t i = 0; i < set.size(); ++i) {
      Rng rng(9, Purpose::kTorque, frame, static_cast<uint32_t>(i));
      propagate(context, set[i], rng);
      EXPECT_EQ(set[i].regime, Regime::kWalking);
    }
}

}  // namespace
}  // namespace walktrack
