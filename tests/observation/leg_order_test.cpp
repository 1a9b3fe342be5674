#include "observation/flow/leg_order.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "observation/flow/leg_order_term.h"
#include "observation/terms.h"
#include "tests/observation/scenes.h"

namespace walktrack {
namespace {

using Eigen::Vector2d;

constexpr int kSize = 120;
constexpr PixelRect kWholeArea{0, 0, kSize, kSize};

// Cloth with stripes, `shift` px to the right.
GreyImage cloth(double shift) {
  GreyImage image{kSize, kSize, {}};
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x)
      image.pixels.push_back(
          static_cast<uint8_t>(std::lround(120 + 40 * std::sin(0.35 * (x - shift) + 0.1 * y))));
  return image;
}

LogRatioPlanes everywhere(float nats) {
  LogRatioPlanes planes;
  resize(planes, kWholeArea, 1);
  for (int y = 0; y < kSize; ++y) set_row(planes, 0, y, std::vector<float>(kSize, nats), 4);
  return planes;
}

enum Index { kLeftThigh, kRightThigh, kLeftShank, kRightShank, kTrunk };
const std::vector<Part>& parts() {
  static const std::vector<Part> all = [] {
    std::vector<Part> made(5);
    made[kLeftThigh].segment = Segment::kLeftThigh;
    made[kRightThigh].segment = Segment::kRightThigh;
    made[kLeftShank].segment = Segment::kLeftShank;
    made[kRightShank].segment = Segment::kRightShank;
    made[kTrunk].segment = Segment::kTrunk;
    return made;
  }();
  return all;
}

// A vertical part.
Capsule upright(int part, double x, double depth) {
  Capsule capsule{};
  capsule.lower = {{x, 90}, 8};
  capsule.upper = {{x, 40}, 10};
  capsule.depth = depth;
  capsule.part = part;
  return capsule;
}

CapsuleList list(std::initializer_list<Capsule> capsules) {
  CapsuleList out;
  for (const Capsule& capsule : capsules) out.insert(capsule);
  return out;
}

// The left shank has moved 4 px to the right, the right one is at rest.
constexpr double kStep = 4;
CapsuleList shanks(double left_depth, double left_x = 60) {
  return list({upright(kLeftShank, left_x, left_depth), upright(kRightShank, 62, 5)});
}

double log_ratio(const GreyImage& before, const GreyImage& now, const CapsuleList& capsules_before,
                 const CapsuleList& capsules, const LogRatioPlanes& planes = everywhere(1)) {
  const FramePair flow = pair_frames(before, now, leg_overlap(parts(), capsules));
  return leg_order_log_ratio(parts(), flow, {capsules_before, everywhere(1)}, {capsules, planes});
}

double shanks_log_ratio(const GreyImage& now, double left_depth) {
  return log_ratio(cloth(0), now, shanks(left_depth, 60 - kStep), shanks(left_depth));
}

TEST(LegOrder, TheLegInFrontIsTheOneWhoseMotionIsSeen) {
  const double swings = shanks_log_ratio(cloth(kStep), 4), stands = shanks_log_ratio(cloth(0), 4);
  EXPECT_GT(swings, 100);
  EXPECT_LT(stands, -100);
  EXPECT_DOUBLE_EQ(shanks_log_ratio(cloth(kStep), 6), -swings) << "the other one in front";
  EXPECT_DOUBLE_EQ(shanks_log_ratio(cloth(0), 6), -stands);
}

TEST(LegOrder, SaysNothingWithoutTexture) {
  const GreyImage grey{kSize, kSize, std::vector<uint8_t>(kSize * kSize, 90)};
  EXPECT_EQ(log_ratio(grey, grey, shanks(4, 60 - kStep), shanks(4)), 0);
}

TEST(LegOrder, SaysNothingOfLegsThatDoNotOverlap) {
  EXPECT_TRUE(leg_overlap(parts(), shanks(4, 20)).empty());
  EXPECT_EQ(log_ratio(cloth(0), cloth(kStep), shanks(4, 20 - kStep), shanks(4, 20)), 0);
  const CapsuleList one = list({upright(kLeftShank, 60, 4)});
  EXPECT_TRUE(leg_overlap(parts(), one).empty());
}

// A subject walks out of the picture, and the figure walks on.
TEST(LegOrder, SaysNothingOfLegsOutsideThePicture) {
  for (const double away : {-300.0, 300.0}) {
    const auto legs = [&](double left_x) {
      return list({upright(kLeftShank, left_x + away, 4), upright(kRightShank, 62 + away, 5)});
    };
    const CapsuleList before = legs(60 - kStep), now = legs(60);
    ASSERT_FALSE(leg_overlap(parts(), now).empty());
    EXPECT_EQ(log_ratio(cloth(0), cloth(kStep), before, now), 0) << away;
  }
}

TEST(LegOrder, SaysNothingOfLegsThatGoTogether) {
  const CapsuleList before =
      list({upright(kLeftShank, 60 - kStep, 4), upright(kRightShank, 62 - kStep, 5)});
  EXPECT_NEAR(log_ratio(cloth(0), cloth(kStep), before, shanks(4)), 0, 1e-6);
}

TEST(LegOrder, DoesNotAskWhatIsHiddenOrLooksLikeTheEmptyScene) {
  const Capsule trunk = upright(kTrunk, 61, 1);
  const CapsuleList before =
      list({trunk, upright(kLeftShank, 60 - kStep, 4), upright(kRightShank, 62, 5)});
  const CapsuleList now = list({trunk, upright(kLeftShank, 60, 4), upright(kRightShank, 62, 5)});
  const double open = shanks_log_ratio(cloth(kStep), 4);
  EXPECT_LT(log_ratio(cloth(0), cloth(kStep), before, now), 0.2 * open);
  EXPECT_EQ(log_ratio(cloth(0), cloth(kStep), shanks(4, 60 - kStep), shanks(4), everywhere(-1)), 0);
}

// A shoe, a hem, the edge of a shadow: a pixel contributes at most 2 ln(12 / 3) nats, however
// bright.
TEST(LegOrder, StrangePixelsDoNotDecide) {
  GreyImage dark{kSize, kSize, std::vector<uint8_t>(kSize * kSize, 20)}, bright = dark;
  for (int y = 0; y < kSize; ++y)
    for (int x = 58; x < kSize; ++x) {
      dark.pixels[static_cast<size_t>(y * kSize + x)] = 250;
      bright.pixels[static_cast<size_t>(y * kSize + x)] = 250;
    }
  const double said = log_ratio(dark, bright, shanks(4, 60 - kStep), shanks(4));
  const PixelRect area = leg_overlap(parts(), shanks(4));
  EXPECT_LT(said, -50) << "nothing moves";
  EXPECT_GT(said, -2 * std::log(12.0 / 3) * (kStep + 2) * area.height());
}

// Hands swing past the upper thighs.
TEST(LegOrder, AsksOnlyTheLowerEndsOfThighs) {
  const auto thighs = [](double left_x) {
    return list({upright(kLeftThigh, left_x, 4), upright(kRightThigh, 62, 5)});
  };
  const double whole = shanks_log_ratio(cloth(kStep), 4);
  const double lower = log_ratio(cloth(0), cloth(kStep), thighs(60 - kStep), thighs(60));
  EXPECT_GT(lower, 0.2 * whole);
  EXPECT_LT(lower, 0.6 * whole);
}

// Cloth that moves by `shift` px, on a person who fills the image.
CameraEvidence cloth_evidence(const Camera& camera, double shift) {
  CameraEvidence out;
  out.picture = {camera.width_px, camera.height_px, {}};
  for (int y = 0; y < camera.height_px; ++y)
    for (int x = 0; x < camera.width_px; ++x)
      out.picture.pixels.push_back(
          static_cast<uint8_t>(std::lround(120 + 40 * std::sin(0.35 * (x - shift) + 0.1 * y))));
  resize(out.planes, {0, 0, camera.width_px, camera.height_px}, 1);
  const std::vector<float> row(static_cast<size_t>(camera.width_px), 1);
  for (int y = 0; y < camera.height_px; ++y) set_row(out.planes, 0, y, row, 4);
  return out;
}

// A person walks to the right in front of a camera on their right-hand side: the right leg is in
// front.
TEST(LegOrderTerm, SpeaksForTheSwingOfTheLegInFront) {
  const Camera camera = camera_at({0, -4, 0.9}, {0, 0, 0.9}, 600);
  const Body body = make_body(Subject{}, {});
  const auto standing_on = [](Side stands, double swing) {
    Pose pose;
    pose.root = {0, 0, 0.93};
    pose.legs[stands == Side::kLeft ? 1 : 0].hip_flexion = swing;
    return pose;
  };
  const CameraEvidence before = cloth_evidence(camera, 0), now = cloth_evidence(camera, 5);
  const auto said = [&](Side stands) {
    return LegOrderTerm::names_log_odds({}, body, camera, before, now,
                                        PosedBody(body, standing_on(stands, -0.02)),
                                        PosedBody(body, standing_on(stands, 0.04)));
  };
  EXPECT_GT(said(Side::kLeft), 1) << "the right leg swings, as the pictures show";
  EXPECT_LT(said(Side::kRight), -1) << "the left leg would swing behind it";
}

}  // namespace
}  // namespace walktrack
