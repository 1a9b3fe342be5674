#include "jobs/track/input/movement.h"

#include <gtest/gtest.h>

namespace walktrack {
namespace {

constexpr double kScale = 0.02;  // m/px
constexpr double kDt = 1.0 / 30;

// A person half a metre wide and 1.6 m high whose left edge is at x, m, in an image of 6.4 m.
SceneEvidence somebody_at(double x) {
  CameraEvidence out;
  resize(out.planes, {0, 0, 320, 120}, 1);
  const int from = static_cast<int>(x / kScale);
  for (int y = 0; y < 120; ++y) {
    std::vector<float> row(320, -2);
    for (int i = from; i < from + 25 && y >= 20 && y < 100; ++i) row[static_cast<size_t>(i)] = 2;
    set_row(out.planes, 0, y, row, 4);
  }
  SceneEvidence evidence;
  evidence.push_back(std::move(out));
  return evidence;
}

TEST(MovementWatch, SeesWhoWalksAndNotWhoStands) {
  MovementWatch walking({kScale}, kDt), standing({kScale}, kDt);
  double walked = 0, stood = 0;
  for (int i = 0; i < 30; ++i) {
    walked = walking.newly_covered(somebody_at(1 + 1.2 * i * kDt));
    stood = standing.newly_covered(somebody_at(1));
  }
  // 1.2 m/s for 0.3 s by 1.6 m, in cells of 0.1 m.
  EXPECT_NEAR(walked, 0.36 * 1.6, 0.1);
  EXPECT_EQ(stood, 0);
}

TEST(MovementWatch, KnowsNothingUntilItHasLookedForAWhile) {
  MovementWatch watch({kScale}, kDt);
  for (int i = 0; i < 9; ++i) EXPECT_EQ(watch.newly_covered(somebody_at(0.2 * i)), 0) << i;
  EXPECT_GT(watch.newly_covered(somebody_at(2)), 0.3);
  watch.forget();
  EXPECT_EQ(watch.newly_covered(somebody_at(4)), 0);
}

TEST(MovementWatch, TheCameraThatSeesMostCounts) {
  MovementWatch watch({kScale, kScale}, kDt);
  double found = 0;
  for (int i = 0; i < 12; ++i) {
    SceneEvidence both = somebody_at(1);
    both.push_back(std::move(somebody_at(1 + 0.04 * i)[0]));
    found = watch.newly_covered(both);
  }
  EXPECT_GT(found, 0.3);
}

}  // namespace
}  // namespace walktrack
