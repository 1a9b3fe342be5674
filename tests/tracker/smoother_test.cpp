#include "tracker/smooth/smoother.h"

#include <cmath>
#include <numeric>

#include <gtest/gtest.h>
#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "core/conventions.h"
#include "core/rng.h"
#include "tests/tracker/frame_time.h"

namespace walktrack {
namespace {

using Curve = double (*)(double t);

// A figure all of whose numbers follow one path.
FrameRecord record_at(double x, double sd = 0.02) {
  FrameRecord record;
  record.tracked = true;
  FrameEstimate& e = record.estimate;
  e.joint_count = kJointCountWithoutArms;
  for (size_t j = 0; j < e.joint_count; ++j) {
    e.joints.at[j].setConstant(x);
    for (Spread& axis : e.spread[j]) axis = {x, sd, x - 2 * sd, x + sd};
  }
  e.pose.root.setConstant(x);
  e.pose.legs[1].knee_flexion = x;
  e.speed = x;
  record.samples.assign(2, e.joints);
  return record;
}

std::vector<FrameRecord> smooth(const std::vector<FrameRecord>& records, double lag = 0.2,
                                double dt = kDt) {
  Smoother smoother({.lag = lag}, dt);
  std::vector<FrameRecord> out;
  for (const FrameRecord& record : records)
    for (FrameRecord& each : smoother.push(record)) out.push_back(std::move(each));
  for (FrameRecord& each : smoother.finish()) out.push_back(std::move(each));
  return out;
}

double x_of(const FrameRecord& record) { return record.estimate.joints[Joint::kLeftKnee].y(); }

// Law: what moves along a parabola is left where it is, at the ends as well, whatever the frames'
// variances.
TEST(Smoother, LeavesParabolasAlone) {
  std::vector<FrameRecord> records;
  for (int i = 0; i < 40; ++i) {
    const double t = i * kDt;
    records.push_back(record_at(0.3 - 1.2 * t + 2 * t * t, 0.01 + 0.01 * (i % 3)));
  }
  const auto smoothed = smooth(records);
  ASSERT_EQ(smoothed.size(), records.size());
  for (size_t i = 0; i < records.size(); ++i) {
    const FrameEstimate &was = records[i].estimate, &is = smoothed[i].estimate;
    EXPECT_NEAR(x_of(smoothed[i]), x_of(records[i]), 1e-9) << i;
    EXPECT_NEAR(is.pose.root.z(), was.pose.root.z(), 1e-9);
    EXPECT_NEAR(is.pose.legs[1].knee_flexion, was.pose.legs[1].knee_flexion, 1e-9);
    EXPECT_NEAR(is.speed, was.speed, 1e-9);
    EXPECT_NEAR(smoothed[i].samples[1].at[5].x(), records[i].samples[1].at[5].x(), 1e-9);
  }
}

// Noise becomes as small as the weights say; bands go with what they are about.
TEST(Smoother, TakesNoiseAway) {
  constexpr double kNoise = 0.01;
  std::vector<FrameRecord> records;
  Rng rng(1, Purpose::kTest);
  for (int i = 0; i < 400; ++i) records.push_back(record_at(kNoise * rng.normal()));
  double before = 0, after = 0;
  const auto smoothed = smooth(records);
  for (size_t i = 0; i < records.size(); ++i) {
    before += std::pow(x_of(records[i]), 2);
    after += std::pow(x_of(smoothed[i]), 2);
    const Spread& spread = smoothed[i].estimate.spread[4][1];
    EXPECT_NEAR(spread.mean, x_of(smoothed[i]), 1e-12);
    EXPECT_NEAR(spread.p95 - spread.mean, 0.02, 1e-12);
    EXPECT_EQ(spread.sd, 0.02);
  }
  std::vector<double> times;
  for (int d = -6; d <= 6; ++d) times.push_back(d * kDt);
  const auto w = smoothing_weights(times, std::vector<double>(times.size(), 1), 0.2);
  const double kept = std::inner_product(w.begin(), w.end(), w.begin(), 0.0);
  EXPECT_LT(kept, 0.4);
  // 5 sigma of the mean square of some 400 / 5 values that are independent.
  EXPECT_NEAR(after / before, kept, 5 * kept * std::sqrt(2.0 / 80));
}

// Oracle: for a walker who is pushed about by white jerk, the exact posterior mean (what a
// Rauch-Tung-Striebel smoother computes), solved as one system over all frames. The parabolas know
// neither jerk nor noise, and come close wherever the lag suits their ratio.
TEST(Smoother, IsHardlyWorseThanTheExactSmootherOfAKnownModel) {
  constexpr int kSampleCount = 150;
  constexpr double kNoise = 0.01, kJerk = 15;  // m, m/s^3 per root Hz: joints of a walker
  // x = A u, u ~ N(0, I): position under integrated unit impulses of jerk, free beginnings.
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(kSampleCount, kSampleCount + 3);
  for (int i = 0; i < kSampleCount; ++i) {
    for (int k = 0; k < 3; ++k) a(i, k) = std::pow(i * kDt, k);
    for (int k = 0; k < i; ++k)
      a(i, 3 + k) = kJerk * std::sqrt(kDt) * std::pow((i - k) * kDt, 2) / 2;
  }
  const Eigen::MatrixXd prior = a * a.transpose();
  const Eigen::MatrixXd noisy =
      prior + kNoise * kNoise * Eigen::MatrixXd::Identity(kSampleCount, kSampleCount);
  const Eigen::MatrixXd exact = noisy.ldlt().solve(prior).transpose();
  double filtered = 0, by_parabolas = 0, by_exact = 0;
  for (uint32_t run = 0; run < 40; ++run) {
    Rng rng(2, Purpose::kTest, run);
    const Eigen::VectorXd truth =
        a *
        Eigen::VectorXd::NullaryExpr(kSampleCount + 3, [&](Eigen::Index) { return rng.normal(); });
    const Eigen::VectorXd seen =
        truth +
        kNoise * Eigen::VectorXd::NullaryExpr(kSampleCount, [&](auto) { return rng.normal(); });
    std::vector<FrameRecord> records;
    for (const double x : seen) records.push_back(record_at(x));
    const auto smoothed = smooth(records);
    Eigen::VectorXd found(kSampleCount);
    for (int i = 0; i < kSampleCount; ++i) found[i] = x_of(smoothed[static_cast<size_t>(i)]);
    filtered += (seen - truth).squaredNorm();
    by_parabolas += (found - truth).squaredNorm();
    by_exact += (exact * seen - truth).squaredNorm();
  }
  EXPECT_LT(by_exact, by_parabolas);
  EXPECT_LT(by_parabolas, 1.25 * by_exact);
  EXPECT_LT(by_parabolas, 0.4 * filtered);
}

TEST(Smoother, WhoWasHiddenFollowsTheNeighbours) {
  std::vector<FrameRecord> records(21, record_at(0));
  records[10] = record_at(0.3, 0.2);  // ten times less sure
  EXPECT_LT(std::abs(x_of(smooth(records)[10])), 0.01);
  records[10] = record_at(0.3);
  EXPECT_GT(std::abs(x_of(smooth(records)[10])), 0.05);
}

TEST(Smoother, NeverAcrossFramesThatAreNotTracked) {
  std::vector<FrameRecord> records(30, record_at(0));
  for (size_t i = 16; i < 30; ++i) records[i] = record_at(5);
  records[15] = FrameRecord{};
  const auto smoothed = smooth(records);
  EXPECT_FALSE(smoothed[15].tracked);
  for (size_t i = 0; i < 15; ++i) EXPECT_NEAR(x_of(smoothed[i]), 0, 1e-12);
  for (size_t i = 16; i < 30; ++i) EXPECT_NEAR(x_of(smoothed[i]), 5, 1e-12);
}

TEST(Smoother, TurnsByTheShorterWay) {
  std::vector<FrameRecord> records;
  for (int i = 0; i < 30; ++i) {
    records.push_back(record_at(0));
    records.back().estimate.pose.heading = std::remainder(2.5 + 0.05 * i, 2 * kPi);
  }
  const auto smoothed = smooth(records);
  for (size_t i = 0; i < records.size(); ++i)
    EXPECT_NEAR(smoothed[i].estimate.pose.heading, records[i].estimate.pose.heading, 1e-9) << i;
}

TEST(Smoother, HandsOutEveryFrameOnceAndNoLaterThanTheLag) {
  Smoother smoother({.lag = 0.1}, kDt);
  size_t out = 0;
  for (size_t i = 0; i < 10; ++i) {
    const auto records = smoother.push(record_at(static_cast<double>(i)));
    for (const FrameRecord& each : records) EXPECT_NEAR(x_of(each), double(out++), 1e-9);
    EXPECT_EQ(out, i < 3 ? 0 : i - 2);
  }
  for (const FrameRecord& each : smoother.finish()) EXPECT_NEAR(x_of(each), double(out++), 1e-9);
  EXPECT_EQ(out, 10u);
}

// Three frames determine a parabola, fewer less: they are passed on.
TEST(Smoother, WhereFramesAreFarApartNothingChanges) {
  std::vector<FrameRecord> records;
  for (int i = 0; i < 12; ++i) records.push_back(record_at(std::sin(1.7 * i)));
  for (const double dt : {1.0 / 7, 1.0}) {
    const auto smoothed = smooth(records, 0.2, dt);
    for (size_t i = 0; i < records.size(); ++i)
      EXPECT_NEAR(x_of(smoothed[i]), x_of(records[i]), 1e-12);
  }
}

TEST(SmoothingWeights, SumToOneAndMirrorThemselves) {
  const std::vector<double> times{-0.15, -0.1, -0.05, 0, 0.05, 0.1, 0.15};
  const std::vector<double> variances{1, 4, 2, 1, 2, 4, 1};
  const auto w = smoothing_weights(times, variances, 0.2);
  EXPECT_NEAR(std::accumulate(w.begin(), w.end(), 0.0), 1, 1e-12);
  for (size_t i = 0; i < 7; ++i) EXPECT_NEAR(w[i], w[6 - i], 1e-12);
  EXPECT_EQ(smoothing_weights(std::vector{0.0}, std::vector{3.0}, 0.2), std::vector{1.0});
}

}  // namespace
}  // namespace walktrack
