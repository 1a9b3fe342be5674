#include "tracker/smooth/estimate.h"

#include <vector>

#include <gtest/gtest.h>

#include "body/kinematics.h"
#include "fixture.h"

namespace walktrack {
namespace {

TEST(WeightedSpread, OfEqualWeights) {
  std::vector<double> values, weights;
  for (int i = 0; i <= 100; ++i) {
    values.push_back(100 - i);
    weights.push_back(1.0 / 101);
  }
  const Spread spread = weighted_spread(values, weights);
  EXPECT_NEAR(spread.mean, 50, 1e-12);
  EXPECT_NEAR(spread.sd, std::sqrt((101.0 * 101 - 1) / 12), 1e-9);
  EXPECT_NEAR(spread.p05, 5, 1);
  EXPECT_NEAR(spread.p95, 95, 1);
}

TEST(WeightedSpread, AHeavyParticleIsAllThereIs) {
  const Spread spread = weighted_spread(std::vector<double>{1, 7, 3}, std::vector<double>{0, 1, 0});
  EXPECT_EQ(spread.mean, 7);
  EXPECT_EQ(spread.sd, 0);
  EXPECT_EQ(spread.p05, 7);
  EXPECT_EQ(spread.p95, 7);
}

TEST(EstimateFrame, OfOneParticleIsItsPose) {
  const Walking walking;
  const MotionContext context = walking.context(1.0 / 30);
  const auto particles = walkers(context, 1.2, 1);
  const FrameEstimate e =
      estimate_frame(walking.model, particles, std::vector<double>{1.0}, context.dt, 1);
  const JointPositions j = forward_kinematics(walking.model.body, particles[0].pose).joints;
  EXPECT_EQ(e.joint_count, size_t{kJointCountWithoutArms});
  for (size_t k = 0; k < e.joint_count; ++k) EXPECT_TRUE(e.joints.at[k].isApprox(j.at[k], 1e-12));
  EXPECT_EQ(e.left_stance, 1.0);
  EXPECT_NEAR(e.pose.heading, particles[0].pose.heading, 1e-12);
}

// Walkers on the less likely foot have no effect, and the time of a quick walker is corrected.
TEST(EstimateFrame, DatesTheTransferByThoseWhoStandOnTheLikelierFoot) {
  const Walking walking;
  const MotionContext context = walking.context(1.0 / 30);
  auto particles = walkers(context, 1.2, 3);
  const std::vector<double> since{0.10, 0.20, 0.90};
  for (size_t i = 0; i < 3; ++i) {
    particles[i].walker.since_transfer = since[i];
    particles[i].stance = i < 2 ? Side::kRight : Side::kLeft;
    particles[i].residual_before[kPace] = i == 1 ? std::log(2.0) : 0;
  }
  const std::vector<double> weights{0.3, 0.3, 0.4};
  const FrameEstimate e = estimate_frame(walking.model, particles, weights, context.dt, 1);
  EXPECT_NEAR(e.since_transfer.mean, 0.10, 1e-12);
  EXPECT_NEAR(e.since_transfer.p95, 0.10, 1e-12);
}

TEST(EstimateFrame, ThreadsDoNotMatter) {
  const Walking walking;
  const MotionContext context = walking.context(1.0 / 30);
  const auto particles = walkers(context, 1.2, 64);
  const std::vector<double> weights(64, 1.0 / 64);
  const FrameEstimate one = estimate_frame(walking.model, particles, weights, context.dt, 1);
  const FrameEstimate many = estimate_frame(walking.model, particles, weights, context.dt, 8);
  for (size_t k = 0; k < one.joint_count; ++k) EXPECT_EQ(one.joints.at[k], many.joints.at[k]);
}

}  // namespace
}  // namespace walktrack
