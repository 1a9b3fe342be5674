#include "observation/flow.h"

#include <cmath>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "core/rng.h"
#include "tests/observation/scenes.h"

namespace walktrack {
namespace {

using Eigen::Vector2d;

constexpr int kSize = 160;

// A smooth random pattern, `shift` px to the right and down.
cv::Mat pattern(const Vector2d& shift) {
  Rng rng(1, Purpose::kTest);
  cv::Mat image(kSize, kSize, CV_8U);
  std::array<std::array<double, 4>, 24> waves;
  for (size_t i = 0; i < waves.size(); ++i) {
    // As in photographs, the longer the wave the stronger.
    const double fastest = 0.7 * static_cast<double>(i + 2) / static_cast<double>(waves.size());
    waves[i] = {draw(rng, -fastest, fastest), draw(rng, -fastest, fastest), draw(rng, 0, 2 * kPi),
                8 / (fastest + 0.2)};
  }
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      double value = 128;
      for (const auto& w : waves)
        value += w[3] * std::sin(w[0] * (x - shift.x()) + w[1] * (y - shift.y()) + w[2]);
      image.at<uint8_t>(y, x) = cv::saturate_cast<uint8_t>(value);
    }
  }
  return image;
}

FlowField measured(const cv::Mat& before, const cv::Mat& now) {
  FlowField field;
  measure_flow({}, before, now, {20, 20, 140, 140}, field);
  return field;
}

TEST(MeasureFlow, FindsShiftsOfFractionsOfAPixel) {
  for (const Vector2d& shift :
       {Vector2d(0, 0), Vector2d(0.4, -0.3), Vector2d(3.5, 1.25), Vector2d(-8, 6)}) {
    const FlowField field = measured(pattern({0, 0}), pattern(shift));
    ASSERT_EQ(field.samples.size(), 900U);
    double error = 0, precision = 0;
    for (const FlowSample& s : field.samples) {
      error += (Vector2d(s.dx, s.dy) - shift).norm();
      precision += 0.5 * static_cast<double>(s.lxx + s.lyy);
    }
    // A tenth of the error that the likelihood assumes for a textured patch, plus a share of the
    // motion.
    EXPECT_LT(error / 900, 0.07 + 0.01 * shift.norm()) << shift.transpose();
    const FlowConfig config;
    const double largest =
        1 / (std::pow(config.error_px, 2) + std::pow(config.error_share * shift.norm(), 2));
    EXPECT_GT(precision / 900, 0.3 * largest) << shift.transpose();
  }
}

TEST(MeasureFlow, TrustsOnlyDirectionsWithTexture) {
  cv::Mat flat(kSize, kSize, CV_8U, cv::Scalar(90)), stripes(kSize, kSize, CV_8U);
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x)
      stripes.at<uint8_t>(y, x) = static_cast<uint8_t>(128 + 80 * std::sin(0.4 * x));
  for (const FlowSample& s : measured(flat, flat).samples) {
    EXPECT_EQ(s.lxx, 0);
    EXPECT_EQ(s.lyy, 0);
  }
  for (const FlowSample& s : measured(stripes, stripes).samples) {
    EXPECT_GT(s.lxx, 0.5);
    EXPECT_LT(s.lyy, 1e-3);
    EXPECT_LT(std::abs(s.lxy), 1e-3);
  }
}

TEST(MeasureFlow, DistrustsWhatDoesNotMatch) {
  Rng rng(2, Purpose::kTest);
  cv::Mat other = pattern({40, 25});  // nothing that the search can reach
  double matching = 0, missing = 0;
  for (const FlowSample& s : measured(pattern({0, 0}), pattern({1, 0})).samples)
    matching += static_cast<double>(s.lxx);
  for (const FlowSample& s : measured(pattern({0, 0}), other).samples)
    missing += static_cast<double>(s.lxx);
  EXPECT_LT(missing, 0.5 * matching);
}

// A field of one motion everywhere, with precision `l` in both directions.
FlowField constant(const Vector2d& motion, float l) {
  FlowField field;
  field.area = {0, 0, 640, 480};
  field.step = 8;
  field.columns = 80;
  field.rows = 60;
  field.samples.assign(4800,
                       {static_cast<float>(motion.x()), static_cast<float>(motion.y()), l, 0, l});
  return field;
}

CapsuleList moved(const CapsuleList& capsules, const Vector2d& by) {
  CapsuleList out;
  for (Capsule c : capsules) {
    c.lower.centre += by;
    c.upper.centre += by;
    out.insert(c);
  }
  return out;
}

CapsuleList one_body() {
  const Body body = make_body(Subject{}, {});
  Pose pose;
  pose.root = {0, 0, 0.95};
  return project_parts(side_camera(), posed(body, pose));
}

TEST(FlowLogRatio, IsLargestForTheMotionSeen) {
  const Vector2d motion(5, -1);
  const FlowField field = constant(motion, 1);
  const CapsuleList before = one_body();
  const auto score = [&](const Vector2d& by) {
    return flow_log_ratio({}, field, moved(before, by), before);
  };
  const double best = score(motion);
  EXPECT_GT(best, 0);
  for (const Vector2d& off : {Vector2d(1, 0), Vector2d(-1, 0), Vector2d(0, 1), Vector2d(0, -1)})
    EXPECT_LT(score(motion + off), best);
  EXPECT_NEAR(score({0, 0}), 0, 1e-9)
      << "a body at rest is explained as well as background at rest";
  EXPECT_LT(score(-motion), 0);
}

TEST(FlowLogRatio, HeavyTailsForgiveOutliers) {
  const CapsuleList before = one_body();
  const FlowField wild = constant({60, 40}, 1);
  const double slightly = flow_log_ratio({}, wild, moved(before, {1, 0}), before);
  FlowConfig nearly_normal;
  nearly_normal.dof = 1000;
  EXPECT_LT(std::abs(slightly),
            0.2 * std::abs(flow_log_ratio(nearly_normal, wild, moved(before, {1, 0}), before)));
}

TEST(FlowLogRatio, SaysNothingWithoutTextureOrOverlap) {
  const CapsuleList before = one_body(), now = moved(before, {4, 0});
  EXPECT_EQ(flow_log_ratio({}, constant({4, 0}, 0), now, before), 0);
  EXPECT_EQ(flow_log_ratio({}, FlowField{}, now, before), 0);
  EXPECT_EQ(flow_log_ratio({}, constant({4, 0}, 1), moved(before, {2000, 0}), before), 0);
  EXPECT_EQ(flow_log_ratio({}, constant({4, 0}, 1), now, CapsuleList{}), 0);
}

TEST(FlowLogRatio, HiddenPointsDoNotCount) {
  const Capsule far{{{100, 100}, 10}, {{100, 160}, 10}, 5, Appearance::kLegs, 0};
  Capsule near = far;
  near.depth = 4;
  near.part = 1;
  near.lower.radius = near.upper.radius = 20;
  CapsuleList only_near, both;
  only_near.insert(near);
  both.insert(near);
  both.insert(far);
  const FlowField field = constant({3, 0}, 1);
  EXPECT_EQ(flow_log_ratio({}, field, moved(both, {3, 0}), both),
            flow_log_ratio({}, field, moved(only_near, {3, 0}), only_near));
}

// A walker seen through a strongly bending lens: the measured field is that of material points,
// computed here from 3-D; the predicted motion must agree with it to a small part of a pixel.
TEST(FlowLogRatio, PredictsMotionThroughTheLens) {
  Camera camera = side_camera();
  const double distortion[] = {-0.25, 0.08, 0.002, -0.001};
  set_distortion(camera, distortion);
  const Eigen::Vector3d velocity(0.06, 0.01, 0.01);  // m a frame
  PosedPart part{{1.6, 0, 0.2}, {1.7, 0, 0.6}, {0, 1, 0},        {0.97, 0, -0.24},
                 {0.05, 0.05},  {0.05, 0.05},  Appearance::kLegs};
  PosedPart later = part;
  later.lower += velocity;
  later.upper += velocity;
  const CapsuleList before = project_parts(camera, std::vector{part});
  const CapsuleList now = project_parts(camera, std::vector{later});
  const Eigen::Vector3d middle = 0.5 * (part.lower + part.upper);
  const Vector2d truth = *project(camera, middle + velocity) - *project(camera, middle);
  const auto score = [&](const Vector2d& motion) {
    return flow_log_ratio({}, constant(motion, 400), now, before);  // sigma 0.05 px
  };
  for (const Vector2d& off :
       {Vector2d(0.15, 0), Vector2d(-0.15, 0), Vector2d(0, 0.15), Vector2d(0, -0.15)})
    EXPECT_LT(score(truth + off), score(truth));
}

}  // namespace
}  // namespace walktrack
