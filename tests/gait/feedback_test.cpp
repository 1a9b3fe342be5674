#include "gait/feedback.h"

#include <gtest/gtest.h>

#include "gait/prior/gait_prior.h"

namespace walktrack {
namespace {

// A - B gain: how deviations continue with the feedback.
SectionMatrix closed_loop(const CycleJacobian& jacobian, const FeedbackGain& gain) {
  return step_matrix(jacobian) - jacobian.block<kSectionSize, kControlSize>(0, 0) * gain;
}

// A scalar system in the first section number, controlled by the first control only: the Riccati
// equation p = 1 + a^2 p - (a b p)^2 / (r + b^2 p) solved by hand.
TEST(Feedback, ScalarSystemMatchesItsRiccatiEquation) {
  CycleJacobian jacobian = CycleJacobian::Zero();
  jacobian.block<kSectionSize, kSectionSize>(0, kControlSize) = -SectionMatrix::Identity();
  const double a = 1.7, b = 0.6, r = 0.3;
  jacobian(0, kControlSize) = a - 1;
  jacobian(0, 0) = b;
  double p = 1;
  for (int i = 0; i < 1000; ++i) p = 1 + a * a * p - (a * b * p) * (a * b * p) / (r + b * b * p);
  const FeedbackGain gain = feedback_gain(jacobian, r);
  EXPECT_NEAR(gain(0, 0), a * b * p / (r + b * b * p), 1e-9);
  EXPECT_LT(gain.norm() - std::abs(gain(0, 0)), 1e-12);
  EXPECT_LT(std::abs(closed_loop(jacobian, gain)(0, 0)), 1);
}

TEST(Feedback, SteadiesAGaitAndCostlyEffortDoesLess) {
  const GaitPrior prior = load_gait_prior();
  const size_t speed = prior.speeds.size() / 2, ratio = prior.ratios.size() / 2;
  const size_t slope = prior.slopes.size() / 2;
  const GaitNode& node = prior.node(speed, ratio, slope);
  const GaitTarget target{prior.speeds[speed],
                          prior.ratios[ratio] * preferred_step_length(prior.speeds[speed]),
                          prior.slopes[slope]};
  const auto jacobian = cycle_jacobian(unit_model(target), node.gait);
  ASSERT_TRUE(jacobian);
  const FeedbackGain cheap = feedback_gain(*jacobian, 0.1), costly = feedback_gain(*jacobian, 1e6);
  EXPECT_LT(multipliers(closed_loop(*jacobian, cheap))[0],
            multipliers(step_matrix(*jacobian))[0] - 0.05);
  EXPECT_LT(costly.norm(), 0.01 * cheap.norm());
}

}  // namespace
}  // namespace walktrack
