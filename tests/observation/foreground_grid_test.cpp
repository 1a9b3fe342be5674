#include "observation/background/foreground_grid.h"

#include <gtest/gtest.h>

namespace walktrack {
namespace {

// A person covers the columns from ... to - 1 of the upper twenty rows.
LogRatioPlanes covered(int from, int to) {
  LogRatioPlanes planes;
  resize(planes, {5, 2, 46, 33}, 1);
  for (int y = 2; y < 33; ++y) {
    std::vector<float> row(41, -1);
    for (int x = from; x < to && y < 22; ++x) row[static_cast<size_t>(x)] = 1;
    set_row(planes, 0, y, row, 4);
  }
  return planes;
}

TEST(ForegroundGrid, CoversCellsInWhichMostPixelsShowABody) {
  const ForegroundGrid grid = foreground_grid(covered(4, 20), 10);
  EXPECT_EQ(grid.columns, 4);
  EXPECT_EQ(grid.rows, 3);
  EXPECT_EQ(grid.covered, (std::vector<uint8_t>{1, 1, 0, 0, 1, 1, 0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(foreground_grid(covered(6, 20), 10).covered[0], 0);
}

TEST(ForegroundGrid, CountsWhatIsNewlyCovered) {
  const auto grid = [](int from, int to) { return foreground_grid(covered(from, to), 10); };
  EXPECT_EQ(newly_covered(grid(10, 30), grid(0, 20)), 2);
  EXPECT_EQ(newly_covered(grid(0, 20), grid(0, 20)), 0) << "who stands covers nothing new";
  EXPECT_EQ(newly_covered(grid(0, 20), foreground_grid({}, 10)), 0) << "nothing was seen before";
}

TEST(ForegroundGrid, AnyPlaneWillDo) {
  LogRatioPlanes planes;
  resize(planes, {0, 0, 10, 10}, 2);
  for (int y = 0; y < 10; ++y) {
    set_row(planes, 0, y, std::vector<float>(10, -1), 4);
    set_row(planes, 1, y, std::vector<float>(10, 0.5), 4);
  }
  EXPECT_EQ(foreground_grid(planes, 10).covered, std::vector<uint8_t>{1});
}

}  // namespace
}  // namespace walktrack
