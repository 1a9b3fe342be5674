#include "metrics/steps/flat_feet.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace walktrack {
namespace {

// Rows every 0.1 s for 4 s.
Motion clock_of(int rows = 40) {
  Motion motion;
  for (int i = 0; i < rows; ++i) motion.time.push_back(0.1 * i + 1e-9);
  motion.joints.assign(motion.time.size(), unknown_joints());
  return motion;
}

struct Cut {
  const char* what;
  Stance stance;
  std::vector<size_t> rows;  // first and last; none: not flat
};

// Complete stances last 1 s here, so that soles are flat from 0.16 to 0.59 s after the strike.
TEST(FlatFeet, ThoseOfStancesThatTheMotionCutsLastAsLongAsWholeOnes) {
  const Stance whole{Side::kRight, 1, 2, true, true, {}};
  const Cut cuts[] = {
      {"whole", {Side::kLeft, 2, 3, true, true, {}}, {22, 25}},
      {"begun long before", {Side::kLeft, 0, 3, false, true, {}}, {0, 25}},
      {"begun just before", {Side::kLeft, 0, 0.9, false, true, {}}, {1, 4}},
      {"begun before, flat at first", {Side::kLeft, 0, 0.7, false, true, {}}, {0, 2}},
      {"begun before, heel up at first", {Side::kLeft, 0, 0.3, false, true, {}}, {}},
      {"still going on", {Side::kLeft, 3, 3.4, true, false, {}}, {32, 33}},
      {"nearly over", {Side::kLeft, 3, 3.9, true, false, {}}, {32, 35}},
      {"not yet flat", {Side::kLeft, 3.8, 3.9, true, false, {}}, {}},
      {"stands in the end", {Side::kLeft, 1, 3.9, true, false, {}}, {12, 38}},
      {"stands all the time", {Side::kLeft, 0, 3.9, false, false, {}}, {0, 38}},
  };
  for (const Cut& cut : cuts) {
    Gait gait;
    gait.stances = {whole, cut.stance};
    const std::vector<FlatFoot> flat = flat_feet(clock_of(), gait);
    const auto left = std::ranges::find(flat, Side::kLeft, &FlatFoot::side);
    ASSERT_EQ(left != flat.end(), !cut.rows.empty()) << cut.what;
    if (cut.rows.empty() && cut.stance.on > 0) continue;
    if (left == flat.end()) continue;
    EXPECT_EQ(left->first, cut.rows[0]) << cut.what;
    EXPECT_EQ(left->last, cut.rows[1]) << cut.what;
  }
}

TEST(FlatFeet, NobodyKnowsWhatIsFlatWithoutAWholeStance) {
  Gait gait;
  gait.stances = {{Side::kLeft, 0, 3, false, true, {}}};
  EXPECT_TRUE(flat_feet(clock_of(), gait).empty());
}

}  // namespace
}  // namespace walktrack
