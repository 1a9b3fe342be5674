#include "tracker/detect/walk_search.h"

#include <limits>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

#include "walked_scene.h"

namespace walktrack {
namespace {

constexpr size_t kFrames = 44, kHidden = 5;

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

// Columns left of one are behind a tree until frame kHidden.
void behind_a_tree(size_t frame, CameraEvidence& evidence) {
  constexpr int kTree = 128;
  if (frame >= kHidden) return;
  for (int y = 0; y < kEvidenceHeight; ++y) {
    std::vector<float> row(kEvidenceWidth);
    for (int x = 0; x < kEvidenceWidth; ++x)
      row[static_cast<size_t>(x)] =
          x < kTree ? -1.0F : static_cast<float>(log_ratio_at(evidence.planes, Appearance{}, x, y));
    set_row(evidence.planes, 0, y, row, 4);
  }
}

TEST_F(Search, StartsAtOnceWithSomebodyWhoIsVisible) {
  show(0.2, kFrames, {{0, -4, 1}});
  uint32_t first = 0;
  const auto found = searched(first);
  ASSERT_TRUE(found);
  EXPECT_EQ(first, 0u);
  EXPECT_EQ(found->lead, 0u);
}

TEST_F(Search, WaitsUntilTheSubjectIsWholeAndBeginsWhereTheyWereFirstSeen) {
  show(0.2, kFrames, {{0, -4, 1}}, behind_a_tree);
  uint32_t first = 0;
  const auto found = searched(first);
  ASSERT_TRUE(found);
  EXPECT_GE(first, 2u);
  EXPECT_LE(first, kHidden);
  EXPECT_GE(found->lead, 2u);
  ASSERT_LE(found->lead, first);
  const DetectedWalk begin = moved(found->walk, -kDt * double(found->lead));
  const DetectedWalk truth = moved(walk_, kDt * double(first - found->lead));
  EXPECT_LT((begin.position - truth.position).norm(), 0.05);
}

}  // namespace
}  // namespace walktrack
