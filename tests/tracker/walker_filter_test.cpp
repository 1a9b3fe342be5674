#include "tracker/walker_filter.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "core/log_weights.h"
#include "fixture.h"
#include "tests/tracker/frame_time.h"

namespace walktrack {
namespace {

struct Advance : testing::Test {
  const Walking walking{};
  const TrackerScene scene = unseen(walking.model, kDt);
  const WalkerFilterContext context{scene, walking.context(kDt), 1, 1};
};

// Without evidence, of two walkers the one whose hips have sunk below the limits of walking loses
// its weight.
TEST_F(Advance, HipsStayUp) {
  std::vector<WalkerParticle> both = walkers(context.motion, 1.2, 2);
  both[1] = both[0];
  for (const ResidualAngle thigh : {kThigh, kThighRight})
    both[1].residual[thigh] = both[1].residual_before[thigh] = rad_from_deg(-30);
  for (const ResidualAngle shank : {kShank, kShankRight})
    both[1].residual[shank] = both[1].residual_before[shank] = rad_from_deg(40);
  FilterConfig plain;
  plain.resample_below = 0;
  plain.max_layers = 1;
  plain.moves = 0;
  WalkerFilter filter(plain, 1, 1);
  filter.start(both);
  const FrameRecord record = advance(context, {}, 0, 1, false, filter);
  ASSERT_TRUE(record.tracked);
  const auto& set = filter.particles();
  ASSERT_LT(set.states[1].pose.root.z(), set.states[0].pose.root.z());
  EXPECT_GT(normalised_weights(set.log_weights)[0], 0.95);
  EXPECT_EQ(record.samples.size(), 1u);
}

TEST_F(Advance, TellsOfThoseWhoFell) {
  std::vector<WalkerParticle> particles = walkers(context.motion, 1.2, 4);
  for (size_t i = 0; i < 3; ++i) {
    particles[i].walker.q[kStanceThigh] -= 0.9;
    particles[i].walker.q[kStanceShank] += 0.9;
  }
  WalkerFilter filter({}, 1, 1);
  filter.start(particles);
  const FrameRecord record = advance(context, {}, 0, 1, false, filter);
  EXPECT_TRUE(record.tracked);
  EXPECT_EQ(record.fallen, 3);
}

// Particles are propagated in groups, but each has its own random numbers.
TEST_F(Advance, ParticlesOfSeveralGroupsGoTheirOwnWays) {
  constexpr size_t kParticles = 70;
  std::vector<WalkerParticle> same = walkers(context.motion, 1.2, int(kParticles));
  std::fill(same.begin() + 1, same.end(), same[0]);
  FilterConfig plain;
  plain.resample_below = 0;
  plain.max_layers = 1;
  plain.moves = 0;
  WalkerFilter filter(plain, 1, 1);
  filter.start(same);
  advance(context, {}, 0, 1, false, filter);
  std::set<double> hips;
  for (const WalkerParticle& particle : filter.particles().states)
    hips.insert(particle.walker.q[kStanceThigh]);
  EXPECT_EQ(hips.size(), kParticles);
}

}  // namespace
}  // namespace walktrack
