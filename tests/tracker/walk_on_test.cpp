#include "tracker/motion/models/walk_on.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/tracker/fixture.h"
#include "tests/tracker/frame_time.h"

namespace walktrack {
namespace {

constexpr int kWalkers = 200;

struct Walkers {
  std::vector<WalkerParticle> particles;
  std::vector<Rng> rngs;
  std::vector<Outcome> outcomes;
};

// Walkers at all moments of their steps; every tenth is bent too far to walk on.
Walkers walkers(const MotionContext& context) {
  Walkers out{walkers_on_their_way(context, kWalkers), {}, {}};
  for (uint32_t i = 0; i < kWalkers; ++i) {
    out.rngs.emplace_back(2, Purpose::kTest, 0, i);
    if (i % 10 != 0) continue;
    out.particles[i].walker.q[kStanceThigh] -= 0.9;
    out.particles[i].walker.q[kStanceShank] += 0.9;
  }
  out.outcomes.resize(kWalkers);
  return out;
}

void expect_same(const Walkers& a, const Walkers& b, double tolerance) {
  for (size_t i = 0; i < kWalkers; ++i) {
    const KneedState &x = a.particles[i].walker, &y = b.particles[i].walker;
    EXPECT_EQ(a.outcomes[i], b.outcomes[i]) << i;
    EXPECT_EQ(a.particles[i].stance, b.particles[i].stance) << i;
    EXPECT_LE((x.q - y.q).norm() + (x.qd - y.qd).norm(), tolerance) << i;
  }
}

TEST(WalkOn, DependsOnNobodyElse) {
  const Walking walking;
  const MotionContext context = walking.context(kDt);
  Walkers together = walkers(context), alone = together;
  walk_on(context, together.particles, together.rngs, together.outcomes);
  for (size_t i = 0; i < kWalkers; ++i)
    walk_on(context, {&alone.particles[i], 1}, {&alone.rngs[i], 1}, {&alone.outcomes[i], 1});
  expect_same(together, alone, 0);
}

TEST(WalkOn, SomeChangeFeetAndFallsAreCaught) {
  const Walking walking;
  const MotionContext context = walking.context(kDt);
  const Walkers before = walkers(context);
  Walkers after = before;
  walk_on(context, after.particles, after.rngs, after.outcomes);
  int changed = 0;
  for (size_t i = 0; i < kWalkers; ++i) {
    const bool falls = i % 10 == 0;
    EXPECT_EQ(after.outcomes[i], falls ? Outcome::kFallen : Outcome::kAlive) << i;
    if (falls) {
      EXPECT_LT((after.particles[i].ball - before.particles[i].ball).norm(), 0.1) << i;
    }
    changed += after.particles[i].stance != before.particles[i].stance;
  }
  // A step of this speed lasts some 17 frames.
  EXPECT_GT(changed, kWalkers / 40);
  EXPECT_LT(changed, kWalkers / 8);
}

// Both legs are behind the hips when it falls, as in videos of 7 Hz: it is at the end of a step,
// although it began only a moment ago.
TEST(WalkOn, AFallLeavesTheHipsWhereTheyAre) {
  const Walking walking;
  const MotionContext context = walking.context(kDt);
  for (WalkerParticle p : walkers_on_their_way(context, kWalkers)) {
    p.walker.q << -0.07, 0.78, 0.44, 1.02, 1.82;
    p.walker.qd << -0.3, 2.5, 1.8, 2.4, 4;
    p.walker.since_transfer = 0.02;
    const auto hips = [&]() -> Eigen::Vector2d {
      return pose_of(context.model, p.walker, p.stance, p.aim, p.ball, p.residual).root.head<2>();
    };
    const Eigen::Vector2d before = hips();
    Rng rng(2, Purpose::kTest);
    Outcome outcome;
    walk_on(context, {&p, 1}, {&rng, 1}, {&outcome, 1});
    ASSERT_EQ(outcome, Outcome::kFallen);
    EXPECT_LT((hips() - before).norm(), 0.1);
  }
}

// On a slope walkers are simulated one by one, each with the gravity in its own plane; on a tiny
// slope the result is that of the batch on level ground.
TEST(WalkOn, ASlopeOfNothingIsLevel) {
  Walking walking;
  const MotionContext level = walking.context(kDt);
  Walkers batch = walkers(level), single = batch;
  walk_on(level, batch.particles, batch.rngs, batch.outcomes);
  walking.model.downhill = {1e-12, 0};
  const MotionContext sloped = walking.context(kDt);
  walk_on(sloped, single.particles, single.rngs, single.outcomes);
  expect_same(batch, single, 1e-7);
}

// A walker that changes feet within a frame has the new step's controls for the rest of it.
TEST(WalkOn, LongFramesAreManyShortOnes) {
  const Walking walking;
  MotionConfig quiet;
  quiet.phase_noise = quiet.control_noise = quiet.aim_drift = 0;
  constexpr int kShorter = 8;
  const MotionContext once = walking.context(0.4, quiet);
  const MotionContext often = walking.context(0.4 / kShorter, quiet);
  std::vector<WalkerParticle> long_frame = walkers(once, 1.3, kWalkers);
  // The next step has another aim than the present one.
  for (WalkerParticle& p : long_frame) p.aim = {1.6, 0.8};
  std::vector<WalkerParticle> short_frames = long_frame;
  std::vector<Rng> rngs(kWalkers, Rng(2, Purpose::kTest));
  std::vector<Outcome> outcomes(kWalkers);
  walk_on(once, long_frame, rngs, outcomes);
  for (int k = 0; k < kShorter; ++k) walk_on(often, short_frames, rngs, outcomes);
  int changed = 0;
  for (size_t i = 0; i < kWalkers; ++i) {
    const KneedState &a = long_frame[i].walker, &b = short_frames[i].walker;
    EXPECT_LE((a.q - b.q).norm(), 1e-3) << i;
    changed += a.since_transfer < 0.4;
  }
  EXPECT_GT(changed, kWalkers / 4);
}

// A slope is downhill for walkers with one heading, uphill for those with the opposite one.
TEST(WalkOn, TheSlopeDependsOnEachWalkersHeading) {
  Walking walking;
  walking.model.downhill = {0.5, 0};
  const MotionContext sloped = walking.context(kDt);
  Walkers down = walkers(sloped), up = down;
  for (WalkerParticle& p : up.particles) p.residual[kHeading] += kPi;
  walk_on(sloped, down.particles, down.rngs, down.outcomes);
  walk_on(sloped, up.particles, up.rngs, up.outcomes);
  int compared = 0, faster = 0;
  for (size_t i = 0; i < kWalkers; ++i) {
    if (down.outcomes[i] != Outcome::kAlive || up.outcomes[i] != Outcome::kAlive) continue;
    // A walker that has just changed feet shows the impact, which was at another moment.
    const KneedState &a = down.particles[i].walker, &b = up.particles[i].walker;
    if (std::min(a.since_transfer, b.since_transfer) < kDt) continue;
    ++compared;
    faster += a.qd[kStanceThigh] > b.qd[kStanceThigh];
  }
  // The supporting leg falls forwards faster, except for a few whose knee gives way.
  EXPECT_GT(compared, kWalkers / 2);
  EXPECT_GT(faster, 0.95 * compared);
}

// 8 % downhill along x.
BodyModel sloped(BodyModel model) {
  const double slope = std::atan(0.08);
  model.downhill = kStandardGravity * Eigen::Vector2d(std::sin(slope), 0);
  model.walker.gravity.y() = -kStandardGravity * std::cos(slope);
  return model;
}

TEST(AimedGait, MeetsTheSlopeOfItsHeading) {
  Walking walking;
  walking.model = sloped(walking.model);
  const MotionContext context = walking.context(kDt);
  WalkerParticle p;
  p.aim = {1.25, 0.7};
  const std::vector<std::pair<double, double>> slopes{
      {0, 0.07983}, {kPi, -0.07983}, {kPi / 2, 0}, {-kPi / 3, 0.03988}};
  for (const auto& [heading, slope] : slopes) {
    p.residual[kHeading] = heading;
    EXPECT_NEAR(aimed_gait(context, p).slope, slope, 1e-4) << heading;
  }
  const Walking level;
  const MotionContext flat = level.context(kDt);
  EXPECT_EQ(aimed_gait(flat, p).slope, 0);
}

// Walkers in their gait continue in it, uphill and downhill: hardly any stumble, and the number of
// steps is as intended. With the gaits of level ground 187 stumbled uphill, and there were a sixth
// of the steps.
TEST(WalkOn, OnASlopeHardlyAnyWalkersStumble) {
  for (const double heading : {0.0, kPi}) {
    Walking walking;
    walking.model = sloped(walking.model);
    walking.moves = make_motion_model(MotionKind::kKneed, walking.model, walking.prior);
    MotionConfig quiet;
    quiet.phase_noise = quiet.control_noise = quiet.aim_drift = 0;
    const MotionContext context = walking.context(kDt, quiet);
    StartConfig start;
    start.particles = kWalkers;
    start.speed = start.step_length = 0.05;
    const DetectedWalk detected{.position = {0, 0}, .velocity = {1.25 * std::cos(heading), 0}};
    Walkers all{spawn(context, start, detected, {Side::kLeft, 0, 1}, 7), {}, {}};
    all.outcomes.resize(kWalkers);
    for (uint32_t i = 0; i < kWalkers; ++i) all.rngs.emplace_back(2, Purpose::kTest, 0, i);
    int stumbled = 0;
    double steps = 0, expected = 0;
    for (WalkerParticle& p : all.particles) p.walker.transfers = 0;
    for (int frame = 0; frame < 60; ++frame) {
      walk_on(context, all.particles, all.rngs, all.outcomes);
      for (const Outcome outcome : all.outcomes) stumbled += outcome != Outcome::kAlive;
    }
    for (const WalkerParticle& p : all.particles) {
      steps += p.walker.transfers;
      expected += 60 * kDt / p.aim.duration();
    }
    EXPECT_LE(stumbled, kWalkers / 100) << heading;
    EXPECT_NEAR(steps / expected, 1, 0.05) << heading;
  }
}

}  // namespace
}  // namespace walktrack
