#include "tracker/start/start.h"

#include <cmath>

#include <gtest/gtest.h>

#include "fixture.h"
#include "tracker/motion/models/markov_motion.h"

namespace walktrack {
namespace {

TEST(PhaseRanges, CoverTheStrideOnce) {
  StartConfig config;
  config.phases = 4;
  const auto ranges = phase_ranges(config);
  ASSERT_EQ(ranges.size(), 8u);
  double left = 0, right = 0;
  for (const PhaseRange& r : ranges) (r.stance == Side::kLeft ? left : right) += r.to - r.from;
  EXPECT_NEAR(left, 1, 1e-12);
  EXPECT_NEAR(right, 1, 1e-12);
}

TEST(PhaseRanges, AStatedPhaseNamesItsFoot) {
  const StartConfig config;
  EXPECT_EQ(phase_ranges(config, 0.25)[0].stance, Side::kLeft);
  EXPECT_EQ(phase_ranges(config, 0.75)[0].stance, Side::kRight);
  EXPECT_EQ(phase_ranges(config, 1.25)[0].stance, Side::kLeft);
  const PhaseRange range = phase_ranges(config, 0.25)[0];
  EXPECT_LT(range.from, 0.5);
  EXPECT_GT(range.to, 0.5);
}

// At a strike the phase may be late in the step before as well as early in the one after.
TEST(PhaseRanges, AStatedPhaseReachesIntoTheStepBeforeAndAfter) {
  const StartConfig config;
  const double width = 1.0 / config.phases;
  for (const double phase : {0.0, 0.02, 0.25, 0.48, 0.5, 0.99}) {
    double length = 0;
    for (const PhaseRange& range : phase_ranges(config, phase)) {
      length += range.to - range.from;
      const double foot = range.stance == Side::kLeft ? 0 : 1;
      for (const double step : {range.from, range.to})
        EXPECT_LE(std::abs(std::remainder(foot + step - 2 * phase, 2)), width + 1e-12) << phase;
    }
    EXPECT_NEAR(length, 2 * width, 1e-12) << phase;
  }
}

TEST(Spawn, ParticlesStandAtTheDetectionAndFaceAhead) {
  const Walking walking;
  const MotionContext context = walking.context(1.0 / 30);
  StartConfig config;
  config.particles = 30;
  const DetectedWalk detected{.position = {2, -1}, .velocity = {0, 1.1}};
  for (const WalkerParticle& p : spawn(context, config, detected, {Side::kRight, 0, 1}, 3)) {
    EXPECT_LT((p.pose.root.head<2>() - detected.position).norm(), 1e-9);
    EXPECT_NEAR(p.pose.heading, kPi / 2, 1e-12);
    EXPECT_EQ(p.stance, Side::kRight);
    EXPECT_GT(p.pose.root.z(), 0.7);
    EXPECT_LT(p.pose.root.z(), 1.0);
  }
}

// A Markov walker stores the root's height, in metres, in the place of an angle.
TEST(StartScale, IsInTheUnitsOfTheModel) {
  const StartConfig config;
  for (const MotionKind kind : {MotionKind::kKneed, MotionKind::kMarkov}) {
    const Walking walking(kind);
    const MotionContext context = walking.context(1.0 / 30);
    const NoiseScale scale = start_scale(config, context.moves, context.config, context.scale);
    if (kind == MotionKind::kMarkov) {
      // Of some 0.9 m, more than it varies later.
      EXPECT_GT(scale.residual[kRootHeight],
                context.moves.constants(context.config, kRootHeight).spread);
      EXPECT_NEAR(scale.residual[kRootHeight], 0.052, 0.004);
    } else {
      EXPECT_EQ(scale.residual[kRootHeight], row_of(kCrouch).process.spread);
    }
    EXPECT_EQ(scale.residual[kList], row_of(kList).process.spread);
    EXPECT_EQ(scale.residual[kHeading], rad_from_deg(config.heading_deg));
  }
}

}  // namespace
}  // namespace walktrack
