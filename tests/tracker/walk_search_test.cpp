#include "tracker/detect/walk_search.h"

#include <limits>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

#include "walked_scene.h"

namespace walktrack {
namespace {

class Search : public WalkedScene {
 protected:
  // The first walk that is found while the window slides, and the frame in which its window begins.
  std::optional<FoundWalk> searched(uint32_t& first) {
    WalkSearch search;
    const TrackContext context = subject_->context();
    const std::optional<LastSeen> nobody;
    first = 0;
    for (const SceneEvidence& frame : window_) {
      search.push(frame);
      if (!search.lasts(context.config.detector.window, kDt)) continue;
      if (auto found = search.find(context, {first, nobody})) return found;
      search.slide(context);
      ++first;
    }
    return std::nullopt;
  }
};

TEST_F(Search, StartsAtOnceWithSomebodyWhoIsVisible) {
  show(0.2, kVideoFrames, {{0, -4, 1}});
  uint32_t first = 0;
  const auto found = searched(first);
  ASSERT_TRUE(found);
  EXPECT_EQ(first, 0u);
  EXPECT_EQ(found->lead, 0u);
}

TEST_F(Search, WaitsUntilTheSubjectIsWholeAndBeginsWhereTheyWereFirstSeen) {
  show_coming_out(0.2, 128);
  uint32_t first = 0;
  const auto found = searched(first);
  ASSERT_TRUE(found);
  EXPECT_GE(first, 2u);
  EXPECT_LE(first, kHiddenFrames);
  EXPECT_GE(found->lead, 2u);
  ASSERT_LE(found->lead, first);
  const DetectedWalk begin = moved(found->walk, -kDt * double(found->lead));
  const DetectedWalk truth = moved(walk_, kDt * double(first - found->lead));
  EXPECT_LT((begin.position - truth.position).norm(), 0.05);
}

}  // namespace
}  // namespace walktrack
