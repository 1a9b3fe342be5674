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

TEST(GaitError, WidensBandsOfEventsAndSharesAboutTheirValues) {
  const GaitTable before = certain_table();
  GaitTable table = before;
  add_gait_error({0, 0.02}, 1, table);
  const auto check = [](const Banded& wide, const Banded& narrow, std::string_view name) {
    ASSERT_FALSE(std::isnan(narrow.value)) << name;
    EXPECT_EQ(wide.value, narrow.value) << name;
    EXPECT_LT(wide.p05, narrow.p05) << name;
    EXPECT_GT(wide.p95, narrow.p95) << name;
  };
  const size_t middle = before.contacts.size() / 2;
  for (const ContactColumn k :
       {kFootStrike, kToeOff, kStepWidth, kStanceShare, kSwingShare, kDoubleSupportShare}) {
    check(table.contacts[middle].at[k], before.contacts[middle].at[k], kContactColumns[k]);
    EXPECT_GE(table.contacts[middle].at[k].p05, 0) << kContactColumns[k];
  }
  for (const ContactColumn k : {kToeClearance, kFootProgression, kWidthAtStrike, kWalkingBase})
    check(table.contacts[middle].at[k], before.contacts[middle].at[k], kContactColumns[k]);
  for (const SummaryColumn k :
       {kMeanStepWidth, kMeanStance, kMeanSwing, kMeanDoubleSupport, kStepLengthSd, kStepTimeSd,
        kMeanToeClearance, kMeanFootProgression, kMeanWidthAtStrike, kMeanWalkingBase})
    EXPECT_GT(width(table.both[k]), width(before.both[k])) << kSummaryColumns[k];
  EXPECT_GT(width(table.symmetry[kStanceSymmetry]), 1);
}

// Two strikes have the same error, which a step and its time do not see.
TEST(GaitError, LeavesLengthsAndTimesToTheSamples) {
  const GaitTable before = certain_table();
  GaitTable table = before;
  add_gait_error({0.02, 0.1}, 1, table);
  const size_t middle = before.contacts.size() / 2;
  for (const ContactColumn k : {kStepLength, kStepTime, kStrideLength, kStrideTime, kStrideSpeed})
    EXPECT_EQ(width(table.contacts[middle].at[k]), width(before.contacts[middle].at[k]));
  for (const SummaryColumn k : {kSpeed, kCadence, kMeanStepLength, kMeanStepTime})
    EXPECT_EQ(width(table.both[k]), width(before.both[k])) << kSummaryColumns[k];
}

TEST(GaitError, WithoutWeightNothingChanges) {
  const GaitTable before = certain_table();
  GaitTable table = before;
  add_gait_error({0.02, 0.1}, 0, table);
  for (size_t k = 0; k < kSummaryColumnCount; ++k)
    EXPECT_NEAR(width(table.both[k]), width(before.both[k]), 1e-12) << kSummaryColumns[k];
}

// A camera at the side places each foot by itself along its rays.
TEST(GaitError, OneCameraMakesWidthsUncertain) {
  GaitTable many = certain_table(), one = many;
  add_gait_error({0.003, 0.013}, 1, many);
  add_gait_error({0.02, 0.11}, 1, one);
  const size_t middle = one.contacts.size() / 2;
  EXPECT_GT(width(one.contacts[middle].at[kStepWidth]),
            3 * width(many.contacts[middle].at[kStepWidth]));
  EXPECT_EQ(width(one.both[kMeanStance]), width(many.both[kMeanStance]));
}

TEST(GaitError, AddsToTheSamplesSpreadInSquares) {
  GaitTable table = certain_table();
  Banded& stance = table.both[kMeanStance];
  stance.p05 = stance.value - 3;
  stance.p95 = stance.value + 3;
  add_gait_error({}, 1, table);
  GaitTable alone = certain_table();
  add_gait_error({}, 1, alone);
  const double error = alone.both[kMeanStance].p95 - alone.both[kMeanStance].value;
  EXPECT_NEAR(stance.p95 - stance.value, std::hypot(3, error), 1e-12);
}

TEST(GaitError, WithoutMembersThereIsStillNoBand) {
  GaitTable table = gait_table(walk_motion({}), {}, {});
  add_gait_error({0.02, 0.1}, 1, table);
  for (const Banded& band : table.both) EXPECT_TRUE(std::isnan(band.p05) && std::isnan(band.p95));
  for (const Banded& band : table.contacts[3].at) EXPECT_TRUE(std::isnan(band.p05));
}

}  // namespace
}  // namespace walktrack
