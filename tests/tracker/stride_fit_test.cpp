#include "tracker/start/stride_fit.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "walked_scene.h"

namespace walktrack {
namespace {

constexpr size_t kShown = 36;  // 1.2 s

class StrideFit : public WalkedScene {
 protected:
  std::vector<PhaseRange> all() const { return phase_ranges(subject_->config.start); }
  std::vector<double> scores() const {
    return stride_scores(subject_->context(), window_, walk_, all());
  }
};

size_t best(const std::vector<double>& scores) {
  return static_cast<size_t>(std::max_element(scores.begin(), scores.end()) - scores.begin());
}

TEST_F(StrideFit, ThePhaseThatIsSeenIsTheBest) {
  for (size_t k = 0; k < 12; ++k) {
    show((static_cast<double>(k) + 0.5) / 12, kShown, {{0, -4, 1}, {3, -3, 1.5}});
    EXPECT_EQ(best(scores()), k);
  }
}

// From the side swapped legs look nearly the same; quarter of a stride away nothing does.
TEST_F(StrideFit, FromTheSideHalfAStrideAwayIsNextBest) {
  show(3.5 / 12, kShown, {{0, -6, 1}});
  const std::vector<double> found = scores();
  EXPECT_EQ(best(found) % 6, 3u);
  const double range = found[3] - *std::min_element(found.begin(), found.end());
  EXPECT_GT(found[9], found[3] - 0.5 * range);
  EXPECT_LT(std::max(found[0], found[6]), found[3] - 0.5 * range);
}

TEST_F(StrideFit, RangesNearTheBestOneAndHalfAStrideFromItAreTried) {
  show(11.5 / 12, kShown, {{0, -4, 1}, {3, -3, 1.5}});
  std::vector<std::pair<Side, double>> tried;
  for (const PhaseRange& range : likely_ranges(subject_->context(), window_, walk_))
    tried.emplace_back(range.stance, std::round(6 * range.from));
  const std::vector<std::pair<Side, double>> expected{{Side::kLeft, 0},  {Side::kLeft, 4},
                                                      {Side::kLeft, 5},  {Side::kRight, 0},
                                                      {Side::kRight, 4}, {Side::kRight, 5}};
  EXPECT_EQ(tried, expected);
}

TEST_F(StrideFit, APhaseThatTheSceneStatesIsTriedAlone) {
  show(0.2, kShown, {{0, -4, 1}});
  subject_->scene.initial_phase = 0.7;  // wrong
  const auto tried = [&] { return likely_ranges(subject_->context(), window_, walk_); };
  EXPECT_EQ(tried().size(), 6u) << "a walk that is found has its own phase";
  walk_.given = true;
  subject_->scene.initial_phase.reset();
  EXPECT_EQ(tried().size(), all().size()) << "perhaps no single frame has evidence";
  subject_->scene.initial_phase = 0.7;
  ASSERT_EQ(tried().size(), 1u);
  EXPECT_EQ(tried()[0].stance, Side::kRight);
  EXPECT_NEAR(0.5 * (tried()[0].from + tried()[0].to), 0.4, 1e-9);
}

TEST_F(StrideFit, WhoStandsFirstHasNoPhase) {
  show(0, kShown, {{0, -4, 1}});
  walk_.standing = true;
  EXPECT_EQ(likely_ranges(subject_->context(), window_, walk_).size(), all().size());
}

TEST_F(StrideFit, WhoIsHalfHiddenFirstMayHaveEveryPhase) {
  show(0, kShown, {{0, -4, 1}});
  walk_.hidden_frames = 1;
  EXPECT_EQ(likely_ranges(subject_->context(), window_, walk_).size(), all().size());
}

}  // namespace
}  // namespace walktrack
