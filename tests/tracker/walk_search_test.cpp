#include "tracker/detect/walk_search.h"

#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

#include "walked_scene.h"

namespace walktrack {
namespace {

class Search : public WalkedScene {
 protected:
  // Slides the window until `done` says so of its first frame.
  void slide(WalkSearch& search, uint32_t& first,
             const std::function<bool(const SearchMoment&)>& done) {
    const TrackContext context = subject_->context();
    const std::optional<LastSeen> nobody;
    first = 0;
    for (const SceneEvidence& frame : window_) {
      search.push(frame);
      if (!search.lasts(context.config.detector.window, kDt)) continue;
      if (done({first, nobody})) return;
      search.slide(context);
      ++first;
    }
  }

  // The first walk that is found while the window slides, and the frame in which its window begins.
  std::optional<FoundWalk> searched(uint32_t& first) {
    WalkSearch search;
    std::optional<FoundWalk> found;
    slide(search, first, [&](const SearchMoment& moment) {
      found = search.find(subject_->context(), moment);
      return found.has_value();
    });
    return found;
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

// The window ends after 1.2 s.
TEST_F(Search, FindsOnlyWhoPassesThePlaceOfTheSubject) {
  show(0.2, 37, {{0, -4, 1}});
  uint32_t first = 0;
  const auto found_near = [&](double seconds, const Eigen::Vector2d& aside) {
    subject_->scene.near = {moved(walk_, seconds).position + aside, seconds / kDt};
    return searched(first).has_value();
  };
  for (const double seconds : {0.0, 1.2}) {
    EXPECT_TRUE(found_near(seconds, {0, 0.3})) << seconds;
    EXPECT_FALSE(found_near(seconds, {0, 0.9})) << seconds;
    EXPECT_FALSE(found_near(seconds, {-0.8, 0})) << seconds;
  }
  EXPECT_TRUE(found_near(3.4, {0, 0.9}));  // a while after the window people may have turned
  EXPECT_FALSE(found_near(3.4, {0, 1.5}));
}

TEST_F(Search, OfThreeWindowsOneIsLookedAt) {
  constexpr size_t kEmptyFrames = 20;
  show(0.2, kEmptyFrames + kVideoFrames, {{0, -4, 1}}, [](size_t frame, CameraEvidence& evidence) {
    if (frame < kEmptyFrames) hide_left_of(kEvidenceWidth, evidence);
  });
  WalkSearch search;
  uint32_t first = 0;
  std::optional<size_t> back;
  slide(search, first, [&](const SearchMoment& moment) {
    back = search.look(subject_->context(), moment, 3);
    EXPECT_TRUE(first != 0 || back == 0u);  // nothing was passed
    EXPECT_TRUE(first % 3 == 0 || !back);
    return back > 0u;
  });
  EXPECT_EQ(back, 2u);
  EXPECT_GE(first, kEmptyFrames - 5);
  EXPECT_LE(first, kEmptyFrames + 2);
  EXPECT_GE(search.waiting(), 2u);  // the windows before it can still be searched
}

// A pixel of somebody 4 m away shows 2 cm, and pixels are independent over 10 cm.
TEST_F(Search, WeighsPixelsByTheDistanceOfAWalkUntilThatIsUndone) {
  constexpr double kUsual = 0.2, kNear = 0.04;
  show(0.2, 40, {{0, -4, 0.9}});
  for (SceneEvidence& frame : window_) frame[0].pixel_weight = kUsual;
  WalkSearch search;
  for (const SceneEvidence& frame : window_) search.push(frame);
  search.let_go(2);
  const std::optional<LastSeen> nobody;
  auto found = search.find(subject_->context(), {2, nobody});
  ASSERT_TRUE(found);
  const double score = found->walk.score;
  search.weigh_at(subject_->context(), *found);
  search.reach_back(2);
  for (const SceneEvidence& frame : search.window())
    EXPECT_NEAR(frame[0].pixel_weight, kNear, 0.05 * kNear);
  // The speed's prior has a share in the score.
  EXPECT_NEAR(found->walk.score, score * kNear / kUsual, 0.05 * score);
  search.restore_evidence(subject_->context());
  for (const SceneEvidence& frame : search.window()) EXPECT_EQ(frame[0].pixel_weight, kUsual);
}

// Towards a camera that is far away, a figure that stands in the middle of the way explains the
// images nearly as well: only from window to window it shows that somebody walks.
class TowardsTheCamera : public Search {
 protected:
  static constexpr size_t kFrames = 80;
  static constexpr double kClear = 0.15;  // share by which a walk is better than standing
  TowardsTheCamera() { show(0.2, kFrames, {{10, 0, 1.2}}); }

  // How many windows back somebody began to walk when it is noticed, in window number `first`.
  std::optional<size_t> noticed(WalkSearch& search, uint32_t& first) {
    std::optional<size_t> back;
    slide(search, first, [&](const SearchMoment& moment) {
      back = search.look(subject_->context(), moment, 3);
      return back > 0u;
    });
    return back;
  }
};

TEST_F(TowardsTheCamera, TheFirstWindowIsBelievedWhenTheWalkHasMovedOn) {
  WalkSearch search;
  uint32_t first = 0;
  const auto back = noticed(search, first);
  ASSERT_TRUE(back);
  EXPECT_LE(first, 30u);
  EXPECT_GE(*back, first - 3) << "about as far back as can be";
  search.step_back(*back);
  const std::optional<LastSeen> nobody;
  const auto begin = static_cast<uint32_t>(first - *back);
  const auto found = search.find(subject_->context(), {begin, nobody});
  ASSERT_TRUE(found);
  EXPECT_LT(found->walk.over_standing, kClear);
  EXPECT_NEAR(found->walk.position.x(), moved(walk_, begin * kDt).position.x(), 0.3);
}

TEST_F(TowardsTheCamera, WhoWalkedBeforeTheWindowDidNotStand) {
  constexpr size_t kBefore = 15;
  const TrackContext context = subject_->context();
  const DetectedWalk walk = moved(walk_, kBefore * kDt);
  const auto lead = [&] {
    WalkSearch search;
    for (const SceneEvidence& frame : window_) search.push(frame);
    search.let_go(kBefore);
    return search.standing_lead(context, walk);
  };
  EXPECT_FALSE(lead());
  Pose standing = standing_pose(subject_->scene.model);
  standing.root.head<2>() = walk.position;
  for (size_t t = 0; t < kBefore; ++t)
    window_[t][0] = evidence_of(subject_->scene.cameras[0], context.body(), standing);
  ASSERT_TRUE(lead());
  EXPECT_EQ(lead()->frames, kBefore);
}

}  // namespace
}  // namespace walktrack
