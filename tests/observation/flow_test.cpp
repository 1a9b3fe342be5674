#include "observation/flow/flow.h"

#include <cmath>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "core/rng.h"
#include "tests/observation/scenes.h"

namespace walktrack {
namespace {

using Eigen::Vector2d;

constexpr int kPictureSide = 160;

// A smooth random pattern, `shift` px to the right and down.
cv::Mat pattern(const Vector2d& shift, int width = kPictureSide, int height = kPictureSide) {
  Rng rng(1, Purpose::kTest);
  cv::Mat image(height, width, CV_8U);
  std::array<std::array<double, 4>, 24> waves;
  for (size_t i = 0; i < waves.size(); ++i) {
    // As in photographs, long waves are stronger.
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

constexpr PixelRect kWholePicture{0, 0, kPictureSide, kPictureSide};

constexpr double kMetresPerPx = 0.015;

GreyImage grey(const cv::Mat& image) {
  return {image.cols, image.rows, {image.data, image.data + image.total()}};
}

FlowField paired(const cv::Mat& before, const cv::Mat& now, const PixelRect& area = kWholePicture,
                 double metres_per_px = kMetresPerPx) {
  FlowField field;
  make_flow_field({}, grey(before), grey(now), {}, area, metres_per_px, field);
  finish_flow_field(field);
  return field;
}

// The whole image moves.
FlowField moving(const Vector2d& motion) { return paired(pattern({0, 0}), pattern(motion)); }

FlowField blank() {
  const cv::Mat plain(kPictureSide, kPictureSide, CV_8U, cv::Scalar(90));
  return paired(plain, plain);
}

TEST(FlowField, LatticeIsAsFineAsTheBodyNeeds) {
  const cv::Mat image = pattern({0, 0});
  EXPECT_EQ(paired(image, image, {0, 0, 120, 120}, 0.045).step, 1);
  EXPECT_EQ(paired(image, image, kWholePicture, 0.015).step, 3);
  const FlowField coarse = paired(image, image, kWholePicture, 0.009);
  EXPECT_EQ(coarse.step, 5);
  EXPECT_EQ(coarse.columns, kPictureSide / 5);
  EXPECT_EQ(coarse.cells.size(), static_cast<size_t>(coarse.columns * coarse.rows));
  const cv::Mat large(600, 800, CV_8U, cv::Scalar(90));
  EXPECT_LE(paired(large, large, {0, 0, 800, 600}, 0.04).cells.size(), kMaxFlowCells);
}

TEST(FlowField, KeepsTheSurroundingsThatTheImageHas) {
  const FlowField field = paired(pattern({0, 0}), pattern({1, 0}), {80, 0, 150, 150});
  EXPECT_LT(field.known.x0, 80);
  EXPECT_GT(field.known.x0, 0);
  EXPECT_EQ(field.known.y0, 0);
  EXPECT_EQ(field.known.x1, kPictureSide);
  EXPECT_TRUE(paired(pattern({0, 0}), pattern({1, 0}), {}).cells.empty());
}

TEST(FlowField, LightThatChangesIsNoMotion) {
  const cv::Mat before = pattern({0, 0});
  cv::Mat brighter;
  before.convertTo(brighter, -1, 1.1);
  EXPECT_NEAR(light_gain(grey(before), grey(brighter)), 1.1, 0.01);
  const FlowField same = paired(before, before), lit = paired(before, brighter);
  double lost = 0;
  for (size_t i = 0; i < same.cells.size(); ++i)
    lost += static_cast<double>(same.cells[i].at_rest - lit.cells[i].at_rest);
  // The rest is due to rounding to integers; it would be 3 without the correction.
  EXPECT_LT(lost / static_cast<double>(same.cells.size()), 0.3) << "nats a cell";
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
  return project_parts(camera_at({0, -6, 1.5}, {0, 0, 0.9}, 300, kPictureSide, kPictureSide),
                       posed(body, pose));
}

// Images of a textured body in front of a static, textured scene.
cv::Mat filmed(const CapsuleList& body, const Vector2d& place) {
  cv::Mat image = pattern({500, 300});
  const cv::Mat cloth = pattern(place);
  for (int y = 0; y < kPictureSide; ++y)
    for (int x = 0; x < kPictureSide; ++x)
      for (const Capsule& part : body)
        if (inside(part, {x, y})) image.at<uint8_t>(y, x) = cloth.at<uint8_t>(y, x);
  return image;
}

TEST(FlowLogRatio, IsLargestForTheMotionSeen) {
  const CapsuleList now = one_body();
  for (const Vector2d& motion : {Vector2d(5, -1), Vector2d(0.5, 0.25), Vector2d(-12, 3)}) {
    const FlowField field = paired(filmed(moved(now, -motion), -motion), filmed(now, {0, 0}));
    const auto score = [&](const Vector2d& by) {
      return flow_log_ratio({}, field, now, moved(now, -by));
    };
    const double best = score(motion);
    EXPECT_GT(best, 0);
    // For a long distance only a share of it is resolved.
    const double apart = 0.4 + FlowConfig{}.error_share * motion.norm();
    for (const Vector2d& off : {Vector2d(1, 0), Vector2d(-1, 0), Vector2d(0, 1), Vector2d(0, -1)})
      EXPECT_LT(score(motion + apart * off), best) << motion.transpose();
    EXPECT_NEAR(score({0, 0}), 0, 1e-3 * best)
        << "a body at rest is explained as well as background at rest";
    EXPECT_LT(score(-motion), best);
  }
}

// It covers background at one side and uncovers some at the other: both places are evidence.
TEST(FlowLogRatio, BothEndsOfTheWayCount) {
  const Vector2d way(4, 0);
  const CapsuleList now = one_body(), before = moved(now, -way);
  const FlowField field = paired(filmed(before, -way), filmed(now, {0, 0}));
  const double best = flow_log_ratio({}, field, now, before);
  EXPECT_GT(best, 0);
  for (const double px : {-4.0, -2.0, -1.0, 1.0, 2.0, 4.0}) {
    const Vector2d off(px, 0);
    EXPECT_LT(flow_log_ratio({}, field, moved(now, off), before), best) << px;
    EXPECT_LT(flow_log_ratio({}, field, now, moved(before, off)), best) << px;
    EXPECT_LT(flow_log_ratio({}, field, moved(now, off), moved(before, off)), best) << px;
  }
}

// Densities are of all pixels for all poses: leaving the image or the body gives no advantage.
TEST(FlowLogRatio, LeavingTheImageGivesNoAdvantage) {
  const CapsuleList there = one_body(), away = moved(there, {2000, 0});
  const FlowField still = moving({0, 0});
  EXPECT_LT(flow_log_ratio({}, still, away, there), -100);
  EXPECT_LT(flow_log_ratio({}, still, there, away), -100);
  EXPECT_LT(flow_log_ratio({}, still, there, CapsuleList{}), -100);
  EXPECT_EQ(flow_log_ratio({}, still, away, away), 0) << "nobody there at all";
}

// The sum of exp(log ratio) p_rest over all grey levels of a pixel is one, both for a body that
// moves and for none; it is tested for a body with the area of one pixel. Because a difference is
// limited to represent a tenth of pixels with any colour, not all of that tenth is used, and some
// values are beyond white: the sum is slightly less than 1.
TEST(FlowLogRatio, IsADensityOfThePicture) {
  const cv::Mat before = pattern({0, 0});
  const auto total = [&](const CapsuleList& now, const CapsuleList& was) {
    double sum = 0;
    cv::Mat after = before.clone();
    for (int level = 0; level < 256; ++level) {
      // So wide that smoothing does not change the middle.
      after(cv::Rect(76, 76, 9, 9)).setTo(level);
      const FlowField field = paired(before, after, {80, 80, 81, 81}, 0.04);
      sum += std::exp(flow_log_ratio({}, field, now, was) +
                      static_cast<double>(field.cells.at(0).at_rest));
    }
    return sum;
  };
  Capsule there{{{80, 60}, 8}, {{80, 100}, 8}, 5, Appearance::kLegs, 0};
  CapsuleList body;
  body.insert(there);
  const CapsuleList none{};
  const double at_rest = total(none, none);
  EXPECT_NEAR(at_rest, 0.92, 0.08);
  EXPECT_NEAR(total(none, body), 1, 1e-3) << "uncovered";
  EXPECT_NEAR(total(body, none), 1, 1e-3) << "from nowhere";
  EXPECT_NEAR(total(body, moved(body, {3, 1})), 0.92, 0.08) << "moved";
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

TEST(FlowLogRatio, SaysNothingWithoutAFrameBefore) {
  EXPECT_EQ(flow_log_ratio({}, FlowField{}, one_body(), one_body()), 0);
}

// Without texture only uncovered pixels are evidence: without a model of the scene they might have
// any colour.
TEST(FlowLogRatio, WithoutTextureTheLeastMotionIsBest) {
  const CapsuleList before = one_body();
  double last = 1;
  for (const double px : {0.0, 2.0, 4.0, 8.0}) {
    const double now = flow_log_ratio({}, blank(), moved(before, {px, 0}), before);
    EXPECT_LT(now, last);
    last = now;
  }
}

// What another part hid in the previous frame might have any colour, and not that part's.
TEST(FlowLogRatio, HiddenPixelsMayHaveAnyColour) {
  const auto leg = [](int part, double x, double depth) {
    return Capsule{{{x, 50}, 10}, {{x, 110}, 10}, depth, Appearance::kLegs, part};
  };
  const auto legs = [&](double near_x, double near_depth) {
    CapsuleList out;
    out.insert(leg(0, 80, 5));
    out.insert(leg(1, near_x, near_depth));
    return out;
  };
  // A striped leg moves aside and uncovers a dark one.
  const auto picture = [&](double near_x) {
    cv::Mat image = pattern({500, 300});
    const cv::Mat cloth = pattern({near_x, 0});
    for (int y = 0; y < kPictureSide; ++y) {
      for (int x = 0; x < kPictureSide; ++x) {
        if (inside(leg(0, 80, 5), {x, y})) image.at<uint8_t>(y, x) = 20;
        if (inside(leg(1, near_x, 4), {x, y})) image.at<uint8_t>(y, x) = cloth.at<uint8_t>(y, x);
      }
    }
    return image;
  };
  const FlowField field = paired(picture(80), picture(105));
  EXPECT_GT(flow_log_ratio({}, field, legs(105, 4), legs(80, 4)),
            flow_log_ratio({}, field, legs(105, 4), legs(80, 6)) + 100);
}

// A walker seen through a strongly distorting lens: the image moves as a material point does, which
// is computed here in 3-D; the predicted motion must agree with it to a small part of a pixel.
TEST(FlowLogRatio, PredictsMotionThroughTheLens) {
  constexpr int kPictureWidth = 320, kPictureHeight = 240;
  Camera camera = camera_at({0, -6, 1.5}, {0, 0, 0.9}, 336, kPictureWidth, kPictureHeight);
  const double distortion[] = {-0.25, 0.08, 0.002, -0.001};
  set_distortion(camera, distortion);
  const Eigen::Vector3d velocity(0.06, 0.01, 0.01);  // m per frame
  PosedPart part{{1.6, 0, 0.2}, {1.7, 0, 0.6}, {0, 1, 0},        {0.97, 0, -0.24},
                 {0.05, 0.05},  {0.05, 0.05},  Appearance::kLegs};
  PosedPart later = part;
  later.lower += velocity;
  later.upper += velocity;
  const CapsuleList before = project_parts(camera, std::vector{part});
  const CapsuleList now = project_parts(camera, std::vector{later});
  const Eigen::Vector3d middle = 0.5 * (part.lower + part.upper);
  const Vector2d truth = *project(camera, middle + velocity) - *project(camera, middle);
  const FlowField field = paired(pattern({0, 0}, kPictureWidth, kPictureHeight),
                                 pattern(truth, kPictureWidth, kPictureHeight),
                                 {0, 0, kPictureWidth, kPictureHeight}, 0.018);
  const auto score = [&](const Vector2d& off) {
    return flow_log_ratio({}, field, now, moved(before, off));
  };
  for (const Vector2d& off :
       {Vector2d(0.4, 0), Vector2d(-0.4, 0), Vector2d(0, 0.4), Vector2d(0, -0.4)})
    EXPECT_LT(score(off), score({0, 0}));
}

}  // namespace
}  // namespace walktrack
