#include "tracker/detect/stature.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/tracker/fixture.h"
#include "tests/tracker/frame_time.h"

namespace walktrack {
namespace {

constexpr size_t kWatched = 36;
const Eigen::Vector2d kWatcher(0, -6), kBegin(-0.8, 0.4), kVelocity(1.3, 0);

DetectedWalk walk_off_by(const Eigen::Vector2d& shift) {
  return {.position = kBegin + shift, .velocity = kVelocity};
}

// A bell over place and height, in which the place moves away from the camera as figures grow: 40
// nats at `height`.
FigureScore person_of(double height, double width) {
  return [=](double tried) -> WindowScore {
    return [=](size_t frame, const Eigen::Vector2d& place, const Eigen::Vector2d&,
               std::optional<size_t>) {
      const Eigen::Vector2d there =
          kBegin + kDt * double(frame) * kVelocity + Eigen::Vector2d(0, 2 * (tried - height));
      const double size = (tried - height) / width;
      return FigureInFrame{
          40 * std::exp(-0.5 * (size * size + (place - there).squaredNorm() / (0.3 * 0.3)))};
    };
  };
}

constexpr double kNear = 0.004, kFar = 0.025;  // m for each pixel

SizedWindow seen_at(double metres_per_px) { return {kWatched, kDt, kWatcher, metres_per_px}; }

SizedWalk sized(double height, double width, const std::optional<Stature>& known = {}) {
  return size_up(walk_off_by({0.1, -0.15}), 1.75, known, person_of(height, width), seen_at(kNear));
}

// Standard deviations of the heights of adults, and of what images show of a height.
constexpr double kAdultsSd = 0.095;
const double kShownSd = std::hypot(0.02, 5 * kNear);

// Standard deviation of the height of `person_of` that width.
double seen_sd(double width) {
  return kStrangeFigure * width / std::sqrt(40 * independent_looks(kWatched, kDt));
}

TEST(SizeUp, FindsTheHeightOfAdultsAndItsLine) {
  for (const double height : {1.62, 1.705, 1.96}) {
    const SizedWalk found = sized(height, 0.2);
    // Images of somebody much taller than usual are wrong by more than those of others.
    const double seen = std::hypot(seen_sd(0.2), kShownSd);
    const double share = kAdultsSd * kAdultsSd / (kAdultsSd * kAdultsSd + seen * seen);
    EXPECT_NEAR(found.stature.height, 1.70 + share * (height - 1.70), 0.02) << height;
    EXPECT_GT(share, 0.5);
    // The line of that height; the climb ends at 1 cm.
    const Eigen::Vector2d begin = kBegin + Eigen::Vector2d(0, 2 * (found.stature.height - height));
    EXPECT_LT((found.walk.position - begin).norm(), 0.03) << height;
  }
}

TEST(SizeUp, AChildIsNoSmallAdult) {
  for (const double height : {1.22, 1.3}) {
    const SizedWalk found = sized(height, 0.2);
    EXPECT_NEAR(found.stature.height, height, 0.03) << height;
    EXPECT_NEAR(found.walk.score, 40, 0.5) << height;
  }
}

TEST(SizeUp, WhatTheSceneSaysOfTheLineCounts) {
  // The line of the tallest figures is far from that which the scene gives.
  const LinePrior given = [](const DetectedWalk& line) {
    return -0.5 * (line.position - kBegin).squaredNorm() / (0.03 * 0.03);
  };
  const auto away = [](const SizedWalk& sized) { return (sized.walk.position - kBegin).norm(); };
  const FigureScore person = person_of(1.95, 0.6);
  SizedWindow window = seen_at(kNear);
  const SizedWalk free = size_up(walk_off_by({0, 0}), 1.75, {}, person, window);
  window.known = given;
  const SizedWalk held = size_up(walk_off_by({0, 0}), 1.75, {}, person, window);
  EXPECT_GT(away(free), 0.15);
  EXPECT_LT(away(held), 0.5 * away(free));
}

TEST(SizeUp, TheSpreadIsThatOfTheEvidenceOfAdultsAndOfPeople) {
  for (const double width : {0.15, 0.6}) {
    const double expected = 1 / std::hypot(1 / std::hypot(seen_sd(width), kShownSd), 1 / kAdultsSd);
    // The bell's flanks are less curved than its top: 5 cm are a third of the narrow one's width.
    EXPECT_NEAR(sized(1.7, width).stature.sd, expected, 0.1 * expected) << width;
  }
}

TEST(SizeUp, SmallImagesSayLess) {
  const auto tall = [](double metres_per_px) {
    return size_up(walk_off_by({0, 0}), 1.75, {}, person_of(1.96, 0.2), seen_at(metres_per_px))
        .stature;
  };
  EXPECT_LT(tall(kFar).height, tall(kNear).height - 0.08);
  EXPECT_GT(tall(kFar).sd, 1.5 * tall(kNear).sd);
}

TEST(SizeUp, WhereImagesSayNothingItIsTheHeightOfPeople) {
  const FigureScore blind = [](double) -> WindowScore {
    return [](size_t, const Eigen::Vector2d&, const Eigen::Vector2d&, std::optional<size_t>) {
      return FigureInFrame{10};
    };
  };
  const SizedWalk found = size_up(walk_off_by({0, 0}), 1.75, {}, blind, seen_at(kNear));
  // Nine adults of 1.70 +- .095 m, and a child of .9 to 1.6.
  EXPECT_NEAR(found.stature.height, 0.9 * 1.70 + 0.1 * 1.25, 2e-3);
  EXPECT_NEAR(found.stature.sd, 0.175, 5e-3);
}

TEST(SizeUp, WhatIsKnownOfTheHeightCounts) {
  // The images say 1.70 m, and before it was 1.80: the result is between the two, and narrower.
  const SizedWalk vague = sized(1.70, 0.2), known = sized(1.70, 0.2, Stature{1.80, 0.03});
  EXPECT_GT(known.stature.height, vague.stature.height + 0.01);
  EXPECT_LT(known.stature.height, 1.795);
  EXPECT_LT(known.stature.sd, vague.stature.sd);
  // Hair and shoes are wrong by as much in the next video: it never becomes more certain than that.
  EXPECT_NEAR(known.stature.sd, kShownSd, 1e-9);
  EXPECT_NEAR(sized(1.70, 0.2, known.stature).stature.sd, kShownSd, 1e-9);
  // Somebody who has been measured stays that tall.
  const SizedWalk measured = sized(1.70, 0.2, Stature{1.80, 0.002});
  EXPECT_NEAR(measured.stature.height, 1.80, 0.002);
  EXPECT_NEAR(measured.stature.sd, 0.002, 1e-9);
  // Also if the images show somebody else.
  const SizedWalk other = sized(1.30, 0.2, Stature{1.80, 0.001});
  EXPECT_NEAR(other.stature.height, 1.80, 0.002);
}

TEST(WithHeight, IsTheModelOfSomebodyThatTall) {
  Subject subject;
  subject.height = 1.6;
  subject.mass = 55;
  subject.lengths.thigh = 0.41;
  BodyModel model = test_model();
  model.body = make_body(subject, {.head = true, .arms = true});
  model.walker = kneed_model(kneed_parameters(subject, kStandardGravity));
  model.walker.gravity.y() = -9.7;  // on a slope
  model.downhill = {0.5, 0};
  const BodyModel taller = with_height(model, 1.9);
  EXPECT_EQ(taller.body.subject.height, 1.9);
  EXPECT_EQ(taller.body.subject.mass, 55);
  EXPECT_EQ(taller.body.lengths.thigh, 0.41);
  EXPECT_DOUBLE_EQ(taller.body.lengths.shank, 1.9 / 1.6 * model.body.lengths.shank);
  EXPECT_EQ(taller.body.parts.size(), model.body.parts.size());
  EXPECT_DOUBLE_EQ(taller.walker.parameters.shank_length, taller.body.lengths.shank);
  EXPECT_EQ(taller.walker.gravity, model.walker.gravity);
  EXPECT_EQ(taller.downhill, model.downhill);
  const BodyModel same = with_height(model, 1.6);
  EXPECT_EQ(same.walker.parameters.torso.mass, model.walker.parameters.torso.mass);
  EXPECT_EQ(same.body.lengths.trunk, model.body.lengths.trunk);
}

}  // namespace
}  // namespace walktrack
