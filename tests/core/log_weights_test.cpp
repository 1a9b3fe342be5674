#include "core/log_weights.h"

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace walktrack {
namespace {

constexpr double kDead = -std::numeric_limits<double>::infinity();

TEST(LogSumExp, SurvivesAMillionNats) {
  const std::vector<double> w{-1e6, -1e6 + std::log(2.0), -2e6};
  EXPECT_NEAR(log_sum_exp(w), -1e6 + std::log(3.0), 1e-9);
}

TEST(LogSumExp, DeadAndEmptySets) {
  EXPECT_EQ(log_sum_exp(std::vector<double>{}), kDead);
  EXPECT_EQ(log_sum_exp(std::vector<double>{kDead, kDead}), kDead);
  EXPECT_DOUBLE_EQ(log_sum_exp(std::vector<double>{kDead, 3.0}), 3.0);
}

TEST(NormalisedWeights, SumToOneUnlessAllAreDead) {
  const auto p = normalised_weights(std::vector<double>{0, kDead, std::log(3.0)});
  EXPECT_DOUBLE_EQ(p[0], 0.25);
  EXPECT_EQ(p[1], 0.0);
  EXPECT_DOUBLE_EQ(p[2], 0.75);
  EXPECT_EQ(normalised_weights(std::vector<double>{kDead}), std::vector<double>{0.0});
}

TEST(EffectiveSampleSize, Table) {
  EXPECT_EQ(effective_sample_size(std::vector<double>{}), 0.0);
  EXPECT_EQ(effective_sample_size(std::vector<double>{kDead, kDead}), 0.0);
  EXPECT_DOUBLE_EQ(effective_sample_size(std::vector<double>{5.0}), 1.0);
  EXPECT_DOUBLE_EQ(effective_sample_size(std::vector<double>{7, 7, 7, 7}), 4.0);
  EXPECT_DOUBLE_EQ(effective_sample_size(std::vector<double>{7, kDead, 7, kDead}), 2.0);
  EXPECT_DOUBLE_EQ(effective_sample_size(std::vector<double>{0, -1e6}), 1.0);
}

TEST(EffectiveSampleSize, ExponentZeroCountsTheLiving) {
  EXPECT_DOUBLE_EQ(effective_sample_size(std::vector<double>{0, -900, kDead}, 0.0), 2.0);
}

}  // namespace
}  // namespace walktrack
