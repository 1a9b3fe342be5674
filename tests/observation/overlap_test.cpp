#include "observation/silhouette/overlap.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/observation/scenes.h"

namespace walktrack {
namespace {

using Eigen::Vector2d;

const PixelRect kPixels{3, 5, 123, 165};

// Two planes; nats of each pixel of either as the functions say.
template <typename First, typename Second>
LogRatioPlanes planes_of(First&& first, Second&& second) {
  LogRatioPlanes planes;
  resize(planes, kPixels, 2);
  planes.plane_of = {0, 1, 1, 0, 0};
  std::vector<float> row(static_cast<size_t>(kPixels.width()));
  for (int y = kPixels.y0; y < kPixels.y1; ++y) {
    for (int x = kPixels.x0; x < kPixels.x1; ++x)
      row[static_cast<size_t>(x - kPixels.x0)] = static_cast<float>(first(Vector2d(x, y)));
    set_row(planes, 0, y, row, 4);
    for (int x = kPixels.x0; x < kPixels.x1; ++x)
      row[static_cast<size_t>(x - kPixels.x0)] = static_cast<float>(second(Vector2d(x, y)));
    set_row(planes, 1, y, row, 4);
  }
  return planes;
}

CapsuleList figure_at(double x) {
  CapsuleList out;
  out.insert({{{x, 60}, 12}, {{x, 90}, 14}, 5, Appearance::kTrunk, 0});
  out.insert({{{x - 8, 100}, 7}, {{x - 12, 130}, 5}, 5.1, Appearance::kLegs, 1});
  out.insert({{{x + 8, 100}, 7}, {{x + 14, 130}, 5}, 4.9, Appearance::kLegs, 2});
  return out;
}

bool in_figure(const CapsuleList& figure, const Vector2d& pixel) {
  return std::any_of(figure.begin(), figure.end(),
                     [&](const Capsule& capsule) { return inside(capsule, pixel); });
}

// A person with the figure's outline at one place.
LogRatioPlanes somebody_at(double x) {
  const auto seen = [figure = figure_at(x)](const Vector2d& pixel) {
    return in_figure(figure, pixel) ? 2.0 : -1.0;
  };
  return planes_of(seen, [](const Vector2d&) { return -3.0; });
}

TEST(Overlap, IsWholeOnThePersonAndNoneBesideThem) {
  EXPECT_EQ(overlap(somebody_at(60), figure_at(60)).share(), 1);
  EXPECT_EQ(overlap(somebody_at(95), figure_at(30)).share(), 0);
}

TEST(Overlap, LeavesOutWhatTheFigureLacks) {
  CapsuleList leg;
  leg.insert(figure_at(60)[0]);
  CapsuleList without;
  for (size_t i = 1; i < figure_at(60).size(); ++i) without.insert(figure_at(60)[i]);
  EXPECT_LT(overlap(somebody_at(60), without).share(), 0.9);
  EXPECT_EQ(overlap(somebody_at(60), without, std::array{leg}).share(), 1);
}

TEST(Overlap, StatesHowMuchOfTheFigureIsSeen) {
  EXPECT_EQ(overlap(somebody_at(60), figure_at(60)).seen, 1);
  const auto left = [](const Vector2d& pixel) { return pixel.x() < 60 ? 1.0 : 0.0; };
  EXPECT_NEAR(overlap(planes_of(left, left), figure_at(60)).seen, 0.5, 0.05);
}

TEST(Overlap, FallsWithTheDistanceFromThePerson) {
  double before = 1;
  for (const double off : {2.0, 5.0, 10.0, 20.0}) {
    const double share = overlap(somebody_at(60), figure_at(60 + off)).share();
    EXPECT_LT(share, before) << off << " px";
    before = share;
  }
}

// Computed pixel by pixel: no runs, no prefix sums.
TEST(Overlap, EqualsTheSumOverPixels) {
  Rng rng(3, Purpose::kTest);
  const auto noise = [&](const Vector2d&) { return std::floor(draw(rng, -800, 800)) / 256; };
  const LogRatioPlanes planes = planes_of(noise, noise);
  const CapsuleList figure = figure_at(40);
  PixelRect box{kPixels.x1, kPixels.y1, kPixels.x0, kPixels.y0};
  const auto each_pixel = [](const PixelRect& area, const auto& visit) {
    for (int y = area.y0; y < area.y1; ++y)
      for (int x = area.x0; x < area.x1; ++x) visit(x, y);
  };
  each_pixel(kPixels, [&](int x, int y) {
    if (!in_figure(figure, Vector2d(x, y))) return;
    box = {std::min(box.x0, x), std::min(box.y0, y), std::max(box.x1, x + 1),
           std::max(box.y1, y + 1)};
  });
  const auto by = static_cast<int>(std::lround(kNearMargin * box.height()));
  Overlap expected;
  each_pixel(intersection({box.x0 - by, box.y0 - by, box.x1 + by, box.y1 + by}, kPixels),
             [&](int x, int y) {
               const double nats = std::max(log_ratio_at(planes, Appearance::kTrunk, x, y),
                                            log_ratio_at(planes, Appearance::kLegs, x, y));
               const bool covered = in_figure(figure, Vector2d(x, y));
               if (nats > 0) (covered ? expected.both : expected.missed) += nats;
               if (nats < 0 && covered) expected.against -= nats;
             });
  const Overlap found = overlap(planes, figure);
  EXPECT_NEAR(found.both, expected.both, 1e-9);
  EXPECT_NEAR(found.against, expected.against, 1e-9);
  EXPECT_NEAR(found.missed, expected.missed, 1e-9);
}

TEST(Overlap, NothingKnownIsNothingFound) {
  const auto nothing = [](const Vector2d&) { return 0.0; };
  EXPECT_EQ(overlap(planes_of(nothing, nothing), figure_at(60)).known(), 0);
  EXPECT_EQ(overlap({}, figure_at(60)).known(), 0);
  EXPECT_EQ(overlap(somebody_at(60), figure_at(900)).known(), 0) << "outside the picture";
}

}  // namespace
}  // namespace walktrack
