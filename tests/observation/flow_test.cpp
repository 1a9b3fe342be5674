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
cv::Mat pattern(const Vector2d& shift, int width = kSize, int height = kSize) {
  Rng rng(1, Purpose::kTest);
  cv::Mat image(height, width, CV_8U);
  std::array<std::array<double, 4>, 24> waves;
  for (size_t i = 0; i < waves.size(); ++i) {
    // As in photographs, the longer the wave the stronger.
    const double fastest = 0.7 * static_cast<double>(i + 2) / static_cast<double>(waves.size());
    waves[i] = {draw(rng, -fastest, fastest), draw(rng, -fastest, fastest), draw(rng, 0, 2 * kPi),
                8 / (fastest + 0.2)};
  }
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      double value = 128;
      for (const auto& w : waves)
        value += w[3] * std::sin(w[0] * (x - shift.x()) + w[1] * (y - shift.y()) + w[2]);
      image.at<uint8_t>(y, x) = cv::saturate_cast<uint8_t>(value);
    }
  }
  return image;
}

constexpr PixelRect kAll{0, 0, kSize, kSize};

FlowField paired(const cv::Mat& before, const cv::Mat& now, const PixelRect& area = kAll) {
  FlowField field;
  pair_frames({}, before, now, area, field);
  return field;
}

// The whole picture moves.
FlowField moving(const Vector2d& motion) { return paired(pattern({0, 0}), pattern(motion)); }

FlowField blank() {
  const cv::Mat grey(kSize, kSize, CV_8U, cv::Scalar(90));
  return paired(grey, grey);
}

TEST(PairFrames, TrustsFlatPixelsMoreThanEdges) {
  cv::Mat step(kSize, kSize, CV_8U, cv::Scalar(60));
  step.colRange(80, kSize).setTo(160);
  const FlowField field = paired(step, step);
  const FlowConfig config;
  EXPECT_NEAR(field.at(20, 50).precision, 1 / std::pow(config.noise, 2), 1e-6);
  EXPECT_LT(field.at(80, 50).precision, 0.5 * std::pow(config.noise, -2));
}

TEST(PairFrames, KeepsTheSurroundingsThatTheImageHas) {
  const FlowField field = paired(pattern({0, 0}), pattern({1, 0}), {60, 0, 150, 150});
  EXPECT_LT(field.area.x0, 60);
  EXPECT_GT(field.area.x0, 0);
  EXPECT_EQ(field.area.y0, 0);
  EXPECT_EQ(field.area.x1, kSize);
  EXPECT_TRUE(paired(pattern({0, 0}), pattern({1, 0}), {}).pixels.empty());
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

// In the middle of the pattern.
CapsuleList one_body() {
  const Body body = make_body(Subject{}, {});
  Pose pose;
  pose.root = {0, 0, 0.95};
  return project_parts(camera_at({0, -6, 1.5}, {0, 0, 0.9}, 300, kSize, kSize), posed(body, pose));
}

TEST(FlowLogRatio, IsLargestForTheMotionSeen) {
  const CapsuleList now = one_body();
  for (const Vector2d& motion : {Vector2d(5, -1), Vector2d(0.5, 0.25), Vector2d(-12, 3)}) {
    const FlowField field = moving(motion);
    const auto score = [&](const Vector2d& by) {
      return flow_log_ratio({}, field, now, moved(now, -by));
    };
    const double best = score(motion);
    EXPECT_GT(best, 0);
    for (const Vector2d& off : {Vector2d(1, 0), Vector2d(-1, 0), Vector2d(0, 1), Vector2d(0, -1)})
      EXPECT_LT(score(motion + 0.4 * off), best) << motion.transpose();
    EXPECT_NEAR(score({0, 0}), 0, 1e-9)
        << "a body at rest is explained as well as background at rest";
    EXPECT_LT(score(-motion), best);
  }
}

TEST(FlowLogRatio, HeavyTailsForgiveOutliers) {
  const CapsuleList before = one_body();
  const FlowField wild = moving({40, 25});
  const double slightly = flow_log_ratio({}, wild, moved(before, {1, 0}), before);
  FlowConfig nearly_normal;
  nearly_normal.dof = 1000;
  EXPECT_LT(std::abs(slightly),
            0.5 * std::abs(flow_log_ratio(nearly_normal, wild, moved(before, {1, 0}), before)));
}

TEST(FlowLogRatio, SaysNothingWithoutTextureOrOverlap) {
  const CapsuleList before = one_body(), now = moved(before, {4, 0});
  EXPECT_EQ(flow_log_ratio({}, blank(), now, before), 0);
  EXPECT_EQ(flow_log_ratio({}, FlowField{}, now, before), 0);
  EXPECT_EQ(flow_log_ratio({}, moving({4, 0}), moved(before, {2000, 0}), before), 0);
  EXPECT_EQ(flow_log_ratio({}, moving({4, 0}), now, moved(before, {2000, 0})), 0);
  EXPECT_EQ(flow_log_ratio({}, moving({4, 0}), now, CapsuleList{}), 0);
}

TEST(FlowLogRatio, HiddenPointsDoNotCount) {
  const Capsule far{{{80, 50}, 10}, {{80, 110}, 10}, 5, Appearance::kLegs, 0};
  Capsule near = far;
  near.depth = 4;
  near.part = 1;
  near.lower.radius = near.upper.radius = 20;
  CapsuleList only_near, both;
  only_near.insert(near);
  both.insert(near);
  both.insert(far);
  const FlowField field = moving({3, 0});
  EXPECT_EQ(flow_log_ratio({}, field, moved(both, {3, 0}), both),
            flow_log_ratio({}, field, moved(only_near, {3, 0}), only_near));
}

// A walker seen through a strongly bending lens: the picture moves as a material point does,
// computed here from 3-D; the predicted motion must agree with it to a small part of a pixel.
TEST(FlowLogRatio, PredictsMotionThroughTheLens) {
  constexpr int kWidth = 320, kHeight = 240;
  Camera camera = camera_at({0, -6, 1.5}, {0, 0, 0.9}, 336, kWidth, kHeight);
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
  FlowField field;
  pair_frames({}, pattern({0, 0}, kWidth, kHeight), pattern(truth, kWidth, kHeight),
              {0, 0, kWidth, kHeight}, field);
  const auto score = [&](const Vector2d& off) {
    return flow_log_ratio({}, field, now, moved(before, off));
  };
  for (const Vector2d& off :
       {Vector2d(0.4, 0), Vector2d(-0.4, 0), Vector2d(0, 0.4), Vector2d(0, -0.4)})
    EXPECT_LT(score(off), score({0, 0}));
}

}  // namespace
}  // namespace walktrack
