#include "tracker/overlaps.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "tests/tracker/frame_time.h"

namespace walktrack {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
using Fits = std::vector<FigureFit>;

FigureFit fit(std::vector<double> overlap, std::vector<double> seen) { return {overlap, seen, 0}; }

// Frames of one camera that sees the whole figure.
Fits frames(size_t count, double overlap) { return Fits(count, fit({overlap}, {1})); }

Fits operator+(Fits a, const Fits& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

double largest_fall(const Fits& fits) { return largest_overlap_fall(fits, kDt, fits.size()); }

TEST(MeanOverlaps, FramesCountByWhatIsKnown) {
  const auto means = mean_overlaps(
      Fits{fit({0.8, kUnknown}, {1, 0}), {}, fit({0.2, kUnknown}, {0.5, 0}), fit({0.2}, {0.5})});
  ASSERT_EQ(means.size(), 2u);
  EXPECT_DOUBLE_EQ(means[0], 0.5);
  EXPECT_TRUE(std::isnan(means[1]));
  EXPECT_TRUE(mean_overlaps({}).empty());
}

TEST(OverlapFall, IsThatOfHalfASecond) {
  EXPECT_NEAR(largest_fall(frames(60, 0.8) + frames(15, 0.6)), 0.2, 1e-12);
  EXPECT_NEAR(largest_fall(frames(60, 0.8) + frames(15, 0.6) + frames(60, 0.8)), 0.2, 1e-12);
  EXPECT_NEAR(largest_fall(frames(60, 0.8) + frames(3, 0.6) + frames(60, 0.8)), 0.04, 1e-12);
  EXPECT_EQ(largest_fall(frames(60, 0.8)), 0);
  EXPECT_EQ(largest_fall({}), 0);
}

// Colours of the subject are learned during the first second.
TEST(OverlapFall, ARiseIsNone) { EXPECT_EQ(largest_fall(frames(40, 0.6) + frames(60, 0.8)), 0); }

TEST(OverlapFall, NeedsASecondBefore) {
  EXPECT_EQ(largest_fall(frames(29, 0.8) + frames(15, 0.6)), 0);
  EXPECT_NEAR(largest_fall(frames(30, 0.8) + frames(15, 0.6)), 0.2, 1e-12);
}

// What was usual more than two seconds ago does not count.
TEST(OverlapFall, IsOneOfTheLastSeconds) {
  EXPECT_NEAR(largest_overlap_fall(frames(40, 0.9) + frames(80, 0.7) + frames(15, 0.6), kDt, 15),
              0.1, 1e-12);
}

TEST(OverlapFall, OnlyStretchesThatEndInTheNewestFramesCount) {
  const Fits fits = frames(60, 0.8) + frames(15, 0.6) + frames(40, 0.8);
  EXPECT_NEAR(largest_overlap_fall(fits, kDt, 41), 0.2, 1e-12);
  EXPECT_EQ(largest_overlap_fall(fits, kDt, 20), 0);
  EXPECT_EQ(largest_overlap_fall(fits, kDt, 0), 0);
}

TEST(OverlapFall, IsThatOfTheWorstCamera) {
  const Fits fits = Fits(60, fit({0.8, 0.7}, {1, 1})) + Fits(15, fit({0.79, 0.5}, {1, 1}));
  EXPECT_NEAR(largest_fall(fits), 0.2, 1e-12);
}

TEST(OverlapFall, NeedsAKnownBackground) {
  const auto fall_at_end = [](const Fits& before, const FigureFit& last) {
    return largest_overlap_fall(before + Fits(15, last), kDt, 1);
  };
  EXPECT_NEAR(fall_at_end(frames(60, 0.8), fit({0.5}, {0.6})), 0.3, 1e-12);
  EXPECT_EQ(fall_at_end(frames(60, 0.8), fit({0.5}, {0.3})), 0);
  EXPECT_EQ(fall_at_end(frames(60, 0.8), fit({kUnknown}, {0})), 0);
  EXPECT_EQ(fall_at_end(frames(60, 0.8), {}), 0) << "not tracked";
  EXPECT_EQ(fall_at_end(Fits(60, fit({0.8}, {0.3})), fit({0.5}, {1})), 0);
}

}  // namespace
}  // namespace walktrack
