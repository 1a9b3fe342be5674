#include "jobs/track/particle_budget.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/message_of.h"

namespace walktrack {
namespace {

constexpr BudgetConfig kThirtyMs{.frame_ms = 30, .least_particles = 20, .most_particles = 1000};

// A machine on which a frame takes a fixed time, plus a time for each particle.
struct Machine {
  double fixed, each;  // s
  double seconds(int particles) const { return fixed + each * particles; }
};

int settled(ParticleBudget& budget, const Machine& machine, int particles, int frames = 100) {
  for (int i = 0; i < frames; ++i)
    particles = budget.next(particles, machine.fixed, machine.each * particles);
  return particles;
}

TEST(ParticleBudget, FillsTheTimeThereIs) {
  const Machine machine{0.010, 1e-4};  // room for 200 particles
  for (const int start : {20, 300, 1000}) {
    ParticleBudget budget(kThirtyMs);
    const int particles = settled(budget, machine, start);
    EXPECT_NEAR(particles, 200, 1) << start;
    EXPECT_NEAR(machine.seconds(particles), 0.030, 2e-4);
  }
}

TEST(ParticleBudget, KeepsItsBounds) {
  ParticleBudget slow(kThirtyMs), fast(kThirtyMs), hopeless(kThirtyMs);
  EXPECT_EQ(settled(slow, {0.029, 1e-3}, 300), 20);
  EXPECT_EQ(settled(fast, {0, 1e-7}, 300), 1000);
  EXPECT_EQ(settled(hopeless, {0.5, 1e-3}, 300), 20);  // not even the fixed work fits
}

TEST(ParticleBudget, LeavesASingleParticle) {
  ParticleBudget budget({.frame_ms = 30, .least_particles = 1, .most_particles = 50});
  EXPECT_EQ(settled(budget, {0, 1e-6}, 1), 50);
}

// A frame that is a hundred times as slow as the others removes a third of the particles at most,
// and they are added again.
TEST(ParticleBudget, OneSlowFrameDoesNotStarveTheNext) {
  const Machine machine{0.010, 1e-4};
  ParticleBudget budget(kThirtyMs);
  const int before = settled(budget, machine, 200);
  const int after = budget.next(before, 1.0, 1.0);
  EXPECT_GE(after, std::floor(before / 1.5));
  EXPECT_NEAR(settled(budget, machine, after), before, 1);
}

TEST(ParticleBudget, RefusesBoundsThatLeaveNothing) {
  EXPECT_EQ(message_of<UsageError>([] {
              ParticleBudget({.frame_ms = 30, .least_particles = 9, .most_particles = 8});
            }),
            "budget.least_particles: found 9, allowed: at most budget.most_particles, 8");
}

TEST(ParticleBudget, IsOffUnlessAskedFor) {
  EXPECT_FALSE(ParticleBudget({}).on());
  EXPECT_TRUE(ParticleBudget(kThirtyMs).on());
}

}  // namespace
}  // namespace walktrack
