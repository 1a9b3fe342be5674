#include "synth/walk/foot_path.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include <gtest/gtest.h>

#include "core/conventions.h"

namespace walktrack {
namespace {

using Eigen::Vector2d;

const BodyLengths kLengths = body_lengths(Subject{});

// A point of the sole, `ahead` of the ankle if it is flat, for this position of the ankle and this
// pitch.
Vector2d sole_point(const Vector2d& ankle, double pitch, double ahead) {
  const double c = std::cos(pitch), s = std::sin(pitch), down = kLengths.ankle_height;
  return ankle + Vector2d(ahead * c - down * s, -ahead * s - down * c);
}

TEST(FootPath, TheHeelStaysWhileTheToesAreUpAndTheBallWhileTheHeelIs) {
  const double heel = -.23 * kLengths.foot, ball = kLengths.ball_forward;
  for (double degrees = -30; degrees <= 75; degrees += 5) {
    const double pitch = rad_from_deg(degrees), pivot = degrees < 0 ? heel : ball;
    const Vector2d place = sole_point(rolled_ankle(kLengths, pitch), pitch, pivot);
    EXPECT_NEAR(place.x(), pivot, 1e-12) << degrees;
    EXPECT_NEAR(place.y(), 0, 1e-12) << degrees;
  }
}

TEST(FootPath, ASwingBeginsAndEndsOnTheGround) {
  for (const double degrees : {-20.0, 60.0}) {
    const double pitch = rad_from_deg(degrees), swing = degrees < 0 ? 1 : 0;
    EXPECT_NEAR(swinging_ankle(kLengths, pitch, swing, .02), rolled_ankle(kLengths, pitch).y(),
                1e-12);
  }
}

TEST(FootPath, MidSwingClearsTheGroundWhateverThePitch) {
  for (double degrees = -25; degrees <= 60; degrees += 5) {
    const double pitch = rad_from_deg(degrees);
    const Vector2d ankle(0, swinging_ankle(kLengths, pitch, .5, .012));
    const double heel = sole_point(ankle, pitch, -.23 * kLengths.foot).y();
    const double tip = sole_point(ankle, pitch, .77 * kLengths.foot).y();
    EXPECT_GE(std::min(heel, tip), .012) << degrees;
    EXPECT_LE(std::min(heel, tip), .012 + .021) << degrees;
  }
}

TEST(FootPath, ThePathHasTheEndsThatItIsGiven) {
  const PathEnd from{{0, 1}, {2, 3}, {4, 5}}, to{{6, 7}, {8, 9}, {-1, -2}};
  const auto at = [&](double s) { return swing_path(from, to, s); };
  constexpr double h = 1e-4;
  for (const auto& [end, s, in] : {std::tuple{from, 0.0, h}, std::tuple{to, 1.0, -h}}) {
    EXPECT_NEAR((at(s) - end.place).norm(), 0, 1e-12);
    EXPECT_NEAR(((at(s + in) - at(s)) / in - end.velocity).norm(), 0, 10 * h);
    const Vector2d bend = (at(s + 2 * in) - 2 * at(s + in) + at(s)) / (h * h);
    EXPECT_NEAR((bend - end.acceleration).norm(), 0, 300 * h);
  }
}

TEST(FootPath, AStepIsSmoothFromNothingToAll) {
  EXPECT_EQ(smooth_step(-1), 0);
  EXPECT_EQ(smooth_step(2), 1);
  EXPECT_DOUBLE_EQ(smooth_step(.5), .5);
  EXPECT_NEAR(smooth_step(.3) + smooth_step(.7), 1, 1e-12);
}

}  // namespace
}  // namespace walktrack
