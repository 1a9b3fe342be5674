#include "tracker/detect/clothes.h"

#include <gtest/gtest.h>

#include "observation/background/colour.h"
#include "tracker/detect/walk_search.h"
#include "walked_scene.h"

namespace walktrack {
namespace {

// Somebody in a red shirt and trousers of the colour that the scene's wood has in shadows: before
// the clothes are known, the trousers are evidence against a figure.
class SubjectInWoodenTrousers : public WalkedScene {
 protected:
  static constexpr float kShirt = 2, kTrousers = -1, kScene = -3;  // nats, of unknown clothes
  static constexpr int kHips = 118;                                // row of the pictures

  SubjectInWoodenTrousers() {
    show(0.2, 36, {{0, -4, 1}},
         [this](size_t, CameraEvidence& evidence) { give_colours(evidence); });
    for (SceneEvidence& frame : window_) forget_clothes(subject_->context(), frame);
  }

  void give_colours(CameraEvidence& evidence) const {
    const ColourBins bins;
    const uint16_t red = bins.bin(90, 80, -20), wood = bins.bin(60, 20, 0),
                   wall = bins.bin(150, 0, 0);
    const ColourTable unknown = broad_table(bins);
    const PixelRect& area = evidence.planes.area;
    evidence.colours.area = area;
    for (int y = area.y0; y < area.y1; ++y) {
      for (int x = area.x0; x < area.x1; ++x) {
        const bool subject = log_ratio_at(evidence.planes, Appearance{}, x, y) > 0;
        const uint16_t bin = !subject ? wall : y < kHips ? red : wood;
        const float nats = !subject ? kScene : y < kHips ? kShirt : kTrousers;
        evidence.colours.bin.push_back(bin);
        evidence.colours.behind.push_back(
            static_cast<int16_t>(LogRatioPlanes::kNat * (unknown[bin] - nats)));
      }
    }
  }

  static WalkSearch searching(const std::deque<SceneEvidence>& window) {
    WalkSearch search;
    for (const SceneEvidence& frame : window) search.push(frame);
    return search;
  }
  std::optional<FoundWalk> found(WalkSearch& search) const {
    const std::optional<LastSeen> nobody;
    return search.find(subject_->context(), {0, nobody});
  }
  double error(const FoundWalk& found) const {
    return (moved(found.walk, 0.6).position - moved(walk_, 0.6).position).norm();
  }
};

TEST_F(SubjectInWoodenTrousers, IsFoundAtTheirPlaceByTheirClothes) {
  WalkSearch search = searching(window_);
  const auto by_clothes = found(search);
  ASSERT_TRUE(by_clothes);
  EXPECT_LT(error(*by_clothes), 0.15);
  for (SceneEvidence& frame : window_) drop_colours(frame);
  search = searching(window_);
  const auto by_differences = found(search);
  ASSERT_TRUE(by_differences);
  EXPECT_GT(error(*by_differences), 0.5);
}

TEST_F(SubjectInWoodenTrousers, TheScoreIsThatOfTheComparedFrames) {
  WalkSearch search = searching(window_);
  const auto walk = found(search);
  ASSERT_TRUE(walk);
  double sum = 0;
  const double heading = std::atan2(walk->walk.velocity.y(), walk->walk.velocity.x());
  for (size_t t = 0; t < search.window().size(); ++t) {
    const TrackContext context = subject_->context();
    const Eigen::Vector2d place = moved(walk->walk, double(t) * kDt).position;
    const auto figures = context.subject.figures.at(walk->walk.velocity.norm(), heading);
    const double score =
        place_score(context.scene, search.window()[t], context.body(), figures, place, heading);
    const Pose best =
        best_figure(context.scene, search.window()[t], context.body(), figures, place, heading)
            .pose;
    EXPECT_EQ(score, place_score(context.scene, search.window()[t], context.body(), {&best, 1},
                                 place, heading));
    sum += score;
  }
  // The speed's prior has a share in the score.
  EXPECT_NEAR(walk->walk.score, sum / double(search.window().size()), 0.5);
}

TEST_F(SubjectInWoodenTrousers, TheEvidenceIsRestoredForAnotherSearchAndKeptForTheTrack) {
  WalkSearch search = searching(window_);
  search.let_go(2);
  ASSERT_TRUE(found(search));
  const auto count_of = [](const WalkSearch& each) {
    return each.window().front()[0].planes.count;
  };
  EXPECT_GT(count_of(search), 1);
  EXPECT_LT(search.window().front()[0].planes.area.width(), kEvidenceWidth);
  search.restore_evidence(subject_->context());
  search.reach_back(2);
  ASSERT_EQ(search.window().size(), window_.size());
  for (size_t t = 0; t < window_.size(); ++t) {
    EXPECT_EQ(search.window()[t][0].planes.prefix, window_[t][0].planes.prefix) << t;
    EXPECT_EQ(search.window()[t][0].planes.area.width(), kEvidenceWidth) << t;
  }
  ASSERT_TRUE(found(search));
  const int classes = count_of(search);
  for (const SceneEvidence& frame : search.take()) {
    EXPECT_EQ(frame[0].planes.count, classes);
    EXPECT_TRUE(frame[0].colours.empty());
  }
}

TEST_F(SubjectInWoodenTrousers, FramesWithoutColoursTeachNothing) {
  EXPECT_TRUE(clothes_of(subject_->context(), window_, walk_));
  for (SceneEvidence& frame : window_) drop_colours(frame);
  EXPECT_FALSE(clothes_of(subject_->context(), window_, walk_));
}

}  // namespace
}  // namespace walktrack
