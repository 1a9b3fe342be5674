#include "metrics/gait_error.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/metrics/test_walk.h"

namespace walktrack {
namespace {

// Members that agree: their bands have no width.
GaitTable certain_table(const TestWalk& walk = {}) {
  const Motion motion = walk_motion(walk);
  return gait_table(motion, {7, [motion](size_t) { return motion; }}, {});
}

double width(const Banded& band) { return band.p95 - band.p05; }

TEST(GaitError, WidensEveryBandAboutItsValue) {
  const GaitTable before = certain_table();
  GaitTable table = before;
  add_gait_error({}, 1, table);
  const auto check = [](const Banded& wide, const Banded& narrow, std::string_view name) {
    if (std::isnan(narrow.value)) return;
    EXPECT_EQ(wide.value, narrow.value) << name;
    EXPECT_LT(wide.p05, narrow.p05) << name;
    EXPECT_GT(wide.p95, narrow.p95) << name;
    EXPECT_GE(wide.p05, 0) << name;
  };
  const size_t middle = before.contacts.size() / 2;
  for (size_t k = 0; k < kContactColumnCount; ++k)
    check(table.contacts[middle].at[k], before.contacts[middle].at[k], kContactColumns[k]);
  for (size_t k = 0; k < kStepLengthSd; ++k)
    check(table.both[k], before.both[k], kSummaryColumns[k]);
  EXPECT_GT(width(table.symmetry[kStepTimeSymmetry]), 1);
}

TEST(GaitError, WithoutWeightNothingChanges) {
  const GaitTable before = certain_table();
  GaitTable table = before;
  add_gait_error({0.02, 0.1}, 0, table);
  for (size_t k = 0; k < kSummaryColumnCount; ++k)
    EXPECT_NEAR(width(table.both[k]), width(before.both[k]), 1e-12) << kSummaryColumns[k];
}

// Nine tenths of a normal error of the speed: 2 % of 1.2 m/s is 0.024 m/s, 1.645 times either way.
TEST(GaitError, SpeedHasTheErrorOfTheDistance) {
  GaitTable table = certain_table();
  add_gait_error({0.02, 0}, 1, table);
  EXPECT_NEAR(width(table.both[kSpeed]), 2 * 1.645 * 0.024, 0.001);
}

// A camera at the side sees the width of steps along its rays, their length across them.
TEST(GaitError, OneCameraMakesWidthsUncertainNotTimes) {
  GaitTable many = certain_table(), one = many;
  add_gait_error({0.003, 0.013}, 1, many);
  add_gait_error({0.02, 0.11}, 1, one);
  EXPECT_GT(width(one.both[kMeanStepWidth]), 3 * width(many.both[kMeanStepWidth]));
  EXPECT_LT(width(one.both[kMeanStepLength]), 2 * width(many.both[kMeanStepLength]));
  EXPECT_EQ(width(one.both[kMeanStepTime]), width(many.both[kMeanStepTime]));
}

TEST(GaitError, AddsToTheMembersSpreadInSquares) {
  GaitTable table = certain_table();
  Banded& time = table.both[kMeanStepTime];
  time.p05 = time.value - 0.03;
  time.p95 = time.value + 0.03;
  add_gait_error({}, 1, table);
  GaitTable alone = certain_table();
  add_gait_error({}, 1, alone);
  const double error = alone.both[kMeanStepTime].p95 - alone.both[kMeanStepTime].value;
  EXPECT_NEAR(time.p95 - time.value, std::hypot(0.03, error), 1e-12);
}

TEST(GaitError, WithoutMembersThereIsStillNoBand) {
  GaitTable table = gait_table(walk_motion({}), {}, {});
  add_gait_error({0.02, 0.1}, 1, table);
  for (const Banded& band : table.both) EXPECT_TRUE(std::isnan(band.p05) && std::isnan(band.p95));
  for (const Banded& band : table.contacts[3].at) EXPECT_TRUE(std::isnan(band.p05));
}

}  // namespace
}  // namespace walktrack
