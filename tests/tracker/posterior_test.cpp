#include "tracker/smooth/posterior.h"

#include <cmath>

#include <gtest/gtest.h>

#include "body/kinematics.h"
#include "fixture.h"
#include "tests/tracker/frame_time.h"

namespace walktrack {
namespace {

constexpr double kNormal95 = 1.6449;  // Abramowitz & Stegun 1964, table 26.5

TEST(MixtureQuantile, OfOneNormalIsItsOwn) {
  const Normal one{2, 0.5}, other{7, 3};
  EXPECT_NEAR(mixture_quantile(one, other, 0, 0.95), 2 + 0.5 * kNormal95, 1e-4);
  EXPECT_NEAR(mixture_quantile(one, other, 1, 0.05), 7 - 3 * kNormal95, 2e-4);
  EXPECT_NEAR(mixture_quantile(one, one, 0.3, 0.5), 2, 1e-9);
}

// Two narrow peaks: a quantile below the first one's share lies in the first, one above it in the
// other, at the quantile that is left of it.
TEST(MixtureQuantile, OfTwoPeaksFollowsTheirShares) {
  const Normal low{0, 0.01}, high{1, 0.01};
  EXPECT_NEAR(mixture_quantile(low, high, 0.04, 0.95), 0.01 * 2.3116, 1e-4);  // .95/.96 of low
  EXPECT_NEAR(mixture_quantile(low, high, 0.2, 0.95), 1 + 0.01 * 0.67449, 1e-5);
  EXPECT_NEAR(mixture_quantile({0, 0}, {1, 0}, 0.2, 0.5), 0, 1e-9);
}

struct Frame {
  BodyModel model = test_model();
  FrameRecord record;
  Pose pose;
  std::vector<Pose> draws;

  Frame() {
    pose.root = {0, 0, 0.95};
    pose.legs[0].hip_flexion = 0.4;
    pose.legs[1].hip_flexion = -0.3;
    record.tracked = true;
    record.estimate.joint_count = kJointCountWithoutArms;
    record.images = {pose, pose, {}};
    record.samples.resize(10);
    for (size_t i = 0; i < kBandDraws; ++i) {
      draws.push_back(pose);
      draws.back().root.x() += i % 2 == 0 ? 0.01 : -0.01;
    }
  }
  const FrameEstimate& report(double model_error) {
    Posterior posterior(model, {{}, model_error, 1}, record.samples.size());
    posterior.report(pose, draws, 1.2, kDt, record);
    return record.estimate;
  }
};

TEST(Posterior, BandsAreThoseOfTheDrawsAboutTheReportedPose) {
  Frame frame;
  const FrameEstimate& estimate = frame.report(0);
  const JointPositions joints = forward_kinematics(frame.model.body, frame.pose).joints;
  EXPECT_EQ(estimate.speed, 1.2);
  for (size_t j = 0; j < kJointCountWithoutArms; ++j) {
    EXPECT_LT((estimate.joints.at[j] - joints.at[j]).norm(), 1e-12);
    const Spread& along = estimate.spread[j][0];
    EXPECT_NEAR(along.mean, joints.at[j].x(), 1e-12);
    EXPECT_NEAR(along.sd, 0.01, 1e-12);
    EXPECT_NEAR(along.p95 - along.mean, kNormal95 * 0.01, 1e-5);
    EXPECT_NEAR(estimate.spread[j][1].sd, 0, 1e-12);
    EXPECT_NEAR(std::abs(frame.record.samples[3].at[j].x() - joints.at[j].x()), 0.01, 1e-12);
  }
  for (const Spread& angle : estimate.angles) EXPECT_NEAR(angle.sd, 0, 1e-9);
}

// Without cameras the figure is known to a metre, and samples stray so far.
TEST(Posterior, TheModelsErrorIsInBandsAndSamples) {
  Frame frame;
  const FrameEstimate& estimate = frame.report(1);
  EXPECT_NEAR(estimate.spread[0][1].sd, 1, 1e-6);
  EXPECT_GT(estimate.angles[kKneeAngleL].sd, 0.05);
  double squares = 0;
  for (const JointPositions& sample : frame.record.samples)
    squares += std::pow(sample[Joint::kPelvis].y() - estimate.joints[Joint::kPelvis].y(), 2) / 10;
  EXPECT_GT(squares, 0.2);
  EXPECT_LT(squares, 3);
}

// Where left and right may be swapped, the band of one foot reaches to the other foot, as many
// samples have their legs swapped, and what is not a leg does not change.
TEST(Posterior, SwappedLegsAreInBandsAndSamples) {
  Frame certain, doubtful;
  doubtful.record.samples.resize(200);
  doubtful.record.modes.p_legs_swapped = 0.5625;  // a third of its odds are those of 0.3
  const FrameEstimate& sure = certain.report(0);
  const FrameEstimate& unsure = doubtful.report(0);
  const auto left = static_cast<size_t>(Joint::kLeftAnkle);
  const double other = sure.joints[Joint::kRightAnkle].x(),
               own = sure.joints[Joint::kLeftAnkle].x();
  ASSERT_LT(other, own - 0.3);
  EXPECT_EQ(unsure.joints[Joint::kLeftAnkle], sure.joints[Joint::kLeftAnkle]);
  EXPECT_NEAR(unsure.spread[left][0].p05, other, 0.02);
  EXPECT_NEAR(unsure.spread[left][0].p95, own, 0.02);
  EXPECT_NEAR(unsure.spread[left][0].sd, std::sqrt(0.3 * 0.7) * (own - other), 0.01);
  EXPECT_NEAR(unsure.spread[0][0].sd, sure.spread[0][0].sd, 1e-9);
  EXPECT_LT(unsure.angles[kHipFlexionL].p05, 0);
  int swapped = 0;
  for (const JointPositions& sample : doubtful.record.samples)
    if (std::abs(sample[Joint::kLeftAnkle].x() - other) < 0.1) ++swapped;
  EXPECT_NEAR(swapped, 60, 5 * std::sqrt(200 * 0.3 * 0.7));
}

}  // namespace
}  // namespace walktrack
