#include "observation/two_views/step_time.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "core/rng.h"

namespace walktrack {
namespace {

constexpr double kRate = 30;

// The head of a person who approaches: it rises and falls by two centimetres, once in each step.
std::vector<double> head_heights(double step, double noise, uint64_t seed) {
  Rng rng(seed, Purpose::kTest);
  std::vector<double> out;
  for (int i = 0; i < 150; ++i) {
    const double time = i / kRate;
    const double bob = 0.02 * std::sin(2 * std::numbers::pi * time / step);
    out.push_back(1.4 + 0.05 * time + 0.01 * time * time + bob + noise * rng.normal());
  }
  return out;
}

TEST(StepTime, IsThatOfTheRisesAndFalls) {
  for (const double step : {0.35, 0.5, 0.65, 0.8})
    for (const uint64_t seed : {1u, 2u, 3u}) {
      std::vector<double> heights = head_heights(step, 0.005, seed);
      for (size_t i = 40; i < 48; ++i) heights[i] = std::numeric_limits<double>::quiet_NaN();
      const auto found = step_time(heights, kRate);
      ASSERT_TRUE(found) << step;
      EXPECT_NEAR(*found, step, 1.1 / kRate) << step;
    }
}

TEST(StepTime, IsNotFoundWhereNothingRepeats) {
  for (const uint64_t seed : {1u, 2u, 3u, 4u, 5u}) {
    std::vector<double> heights = head_heights(0.5, 0, seed);
    Rng rng(seed, Purpose::kTest);
    for (double& each : heights) each = rng.normal();
    EXPECT_FALSE(step_time(heights, kRate)) << seed;
  }
  EXPECT_FALSE(step_time({}, kRate));
  EXPECT_FALSE(step_time(std::vector<double>(200, 1.4), kRate));
  EXPECT_FALSE(step_time(std::vector<double>(200, std::nan("")), kRate));
}

TEST(StepTime, WholeStepsAreOneOrMore) {
  EXPECT_FALSE(is_whole_steps(0, 0.5));
  EXPECT_FALSE(is_whole_steps(0.07, 0.5));
  EXPECT_FALSE(is_whole_steps(0.25, 0.5));
  EXPECT_FALSE(is_whole_steps(-0.4, 0.5));
  EXPECT_TRUE(is_whole_steps(-0.45, 0.5));
  EXPECT_TRUE(is_whole_steps(0.55, 0.5));
  EXPECT_TRUE(is_whole_steps(1.0, 0.5));
}

}  // namespace
}  // namespace walktrack
