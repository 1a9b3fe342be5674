#include "tracker/motion/step_library.h"

#include <cmath>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "fixture.h"

namespace walktrack {
namespace {

constexpr StepAim kUsual{1.3, 0.7};

Rng library_stream(uint32_t i) { return {5, Purpose::kTest, 0, i}; }

// The library has the result of a simulation from the support transfer.
TEST(StepLibrary, MomentsAreThoseOfTheGait) {
  const Walking walking;
  const StepLibrary steps(walking.model, walking.prior);
  const KneedModel& model = walking.model.walker;
  Rng rng = library_stream(0);
  const LibraryStep* step = steps.near(kUsual, 0, rng);
  ASSERT_NE(step, nullptr);
  const PriorGait gait =
      gait_at(walking.prior, model.parameters, step->aim.speed, step->aim.step_length);
  EXPECT_NEAR(step->aim.speed, gait.speed, 1e-9);
  for (size_t k = 0; k < LibraryStep::kMoments; ++k) {
    const KneedState state = state_at_phase(model, gait, double(k) / LibraryStep::kMoments);
    // Simulated in as many pieces, each with its own last time step: the integrator's error.
    EXPECT_LT((step->moments[k].q - state.q).norm(), 1e-4) << k;
    EXPECT_NEAR(step->moments[k].since_transfer, state.since_transfer, 1e-9);
  }
}

TEST(StepLibrary, NearStepsAreNearAndSeveral) {
  const Walking walking;
  const StepLibrary steps(walking.model, walking.prior);
  std::set<const LibraryStep*> found;
  for (uint32_t i = 0; i < 200; ++i) {
    Rng rng = library_stream(i);
    const LibraryStep* step = steps.near(kUsual, 0, rng);
    ASSERT_NE(step, nullptr);
    EXPECT_NEAR(step->aim.speed, kUsual.speed, 0.25);
    EXPECT_NEAR(step->aim.step_length, kUsual.step_length, 0.25);
    found.insert(step);
  }
  EXPECT_EQ(found.size(), 9u);  // three speeds by three lengths
}

// Metropolis-Hastings requires equal probabilities in both directions.
TEST(StepLibrary, DrawsWithEqualProbabilityInBothDirections) {
  const Walking walking;
  const StepLibrary steps(walking.model, walking.prior);
  Rng first = library_stream(0);
  const LibraryStep* here = steps.near(kUsual, 0, first);
  constexpr int kDraws = 4000;
  std::map<const LibraryStep*, int> there;
  for (uint32_t i = 0; i < kDraws; ++i) {
    Rng rng = library_stream(i);
    ++there[steps.near(here->aim, 0, rng)];
  }
  for (const auto& [step, count] : there) {
    int back = 0;
    for (uint32_t i = 0; i < kDraws; ++i) {
      Rng rng = library_stream(kDraws + i);
      back += steps.near(step->aim, 0, rng) == here;
    }
    // Both are a ninth: four standard deviations of the difference.
    EXPECT_NEAR(count, back, 4 * std::sqrt(2.0 * kDraws / 9));
  }
}

TEST(StepLibrary, NothingBeyondTheTable) {
  const Walking walking;
  const StepLibrary steps(walking.model, walking.prior);
  for (const StepAim aim : {StepAim{0.1, 0.7}, StepAim{9, 0.7}, StepAim{1.3, 5}}) {
    Rng rng = library_stream(0);
    EXPECT_EQ(steps.near(aim, 0, rng), nullptr) << aim.speed << ' ' << aim.step_length;
  }
}

}  // namespace
}  // namespace walktrack
