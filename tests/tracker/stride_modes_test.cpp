#include "tracker/modes/stride_modes.h"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "fixture.h"
#include "tracker/moves/mirror_legs.h"

namespace walktrack {
namespace {

double around(double phase) { return phase - std::floor(phase); }

TEST(StridePhase, IsHalfAStrideOnWithTheLegsMirrored) {
  const Walking walking;
  const MotionContext context = walking.context(1.0 / 30);
  for (WalkerParticle& particle : walkers(context, 1.2, 40)) {
    const double phase = stride_phase(particle);
    EXPECT_GE(phase, 0);
    EXPECT_LT(phase, 0.5);  // all of them stand on the left foot
    particle.stance = Side::kRight;
    EXPECT_DOUBLE_EQ(stride_phase(particle), phase + 0.5);
  }
}

TEST(StridePhase, ALateStrikeIsStillExpected) {
  const Walking walking;
  WalkerParticle particle = walkers(walking.context(1.0 / 30), 1.2, 1)[0];
  particle.walker.since_transfer = 3 * particle.aim.duration();
  EXPECT_NEAR(stride_phase(particle), 0.5, 1e-6);
  EXPECT_LT(stride_phase(particle), 0.5);
}

// Two modes of known masses, anywhere in the stride, each spread over a tenth of it.
TEST(Modes, AreWeightedAnywhereInTheStride) {
  for (const double minor : {0.0, 0.1, 0.3, 0.49}) {
    for (double phase = 0; phase < 1; phase += 0.07) {
      std::vector<double> phases, weights;
      for (int i = 0; i < 50; ++i) {
        const double off = 0.1 * (i - 24.5) / 50;
        phases.push_back(around(phase + off));
        weights.push_back((1 - minor) / 50);
        phases.push_back(around(phase + 0.5 + off));
        weights.push_back(minor / 50);
      }
      const double leading = leading_phase(phases, weights);
      EXPECT_NEAR(std::remainder(leading - phase, 1.0), 0, 1e-9);
      EXPECT_NEAR(mass_apart(leading, phases, weights), minor, 1e-9);
    }
  }
}

TEST(Modes, OfEqualMassAreHalfEach) {
  const std::vector<double> phases{0.2, 0.7}, weights{0.5, 0.5};
  EXPECT_NEAR(mass_apart(leading_phase(phases, weights), phases, weights), 0.5, 1e-12);
}

TEST(LabelSwitching, IsHalfAStrideWhileTheLegsPass) {
  EXPECT_TRUE(label_switched(0.24, 0.77));
  EXPECT_TRUE(label_switched(0.74, 0.29));
  EXPECT_TRUE(label_switched(0.70, 0.15));
  EXPECT_FALSE(label_switched(0.02, 0.51)) << "both feet are on the ground";
  EXPECT_FALSE(label_switched(0.24, 0.98)) << "out of a passing";
  for (double phase = 0; phase < 1; phase += 0.01)
    for (double on = -0.37; on < 0.375; on += 0.01)
      EXPECT_FALSE(label_switched(phase, around(phase + on)));
}

// No walker changes its phase like this, at any moment and frame rate; a walker whose legs are
// swapped while they pass each other seems to.
TEST(LabelSwitching, IsNotTheEffectOfAWalk) {
  const Walking walking;
  for (const double rate : {30.0, 7.0}) {
    MotionConfig config;
    config.phase_jump_rate = 0;  // which make sets switch
    const MotionContext context = walking.context(1 / rate, config);
    int frames = 0, told = 0;
    for (WalkerParticle& particle : walkers_on_their_way(context, 20)) {
      for (uint32_t frame = 0; frame < 3 * rate; ++frame) {
        const double expected = phase_ahead({&particle, 1}, std::array{1.0}, context.dt);
        Rng rng(5, Purpose::kTest, frame);
        if (propagate(context, particle, rng) != Outcome::kAlive) break;
        ++frames;
        ASSERT_FALSE(label_switched(expected, stride_phase(particle))) << expected;
        WalkerParticle mirrored = particle;
        mirror_legs(context, mirrored);
        told += label_switched(expected, stride_phase(mirrored)) ? 1 : 0;
      }
    }
    EXPECT_GT(frames, 100) << "unseen walkers fall sooner or later";
    EXPECT_NEAR(double(told) / frames, 0.5, 0.15) << "legs pass in half of the time";
  }
}

}  // namespace
}  // namespace walktrack
