#include "tracker/figure/girth.h"

#include <vector>

#include <gtest/gtest.h>

#include "walked_scene.h"

namespace walktrack {
namespace {

// Somebody of some girth who walks past one camera, and the true poses as the records of a start.
class Girth : public WalkedScene {
 protected:
  static constexpr size_t kFrames = 12;
  void show_girth(double girth, const Eigen::Vector3d& camera = {0, -3, 1}) {
    girth_ = girth;
    show(0.2, kFrames, {camera});
    records_.assign(kFrames, {});
    for (size_t t = 0; t < kFrames; ++t) {
      records_[t].tracked = true;
      records_[t].estimate.pose = poses_[t];
    }
  }
  std::optional<double> found() const { return larger_girth({subject_->scene, window_, records_}); }
  std::vector<FrameRecord> records_;
};

TEST_F(Girth, OfAWidePersonIsFoundAndNotOfOthers) {
  for (const double girth : {1.35, 1.45}) {
    show_girth(girth);
    ASSERT_TRUE(found()) << girth;
    // Made outlines have no pixels that are covered in part.
    EXPECT_NEAR(*found() + 0.05, girth, 0.05);
  }
  for (const double girth : {0.8, 1.0, 1.05}) {
    show_girth(girth);
    EXPECT_FALSE(found()) << girth;
  }
}

TEST_F(Girth, IsAtMostHalfAsLargeAgain) {
  show_girth(1.9);
  ASSERT_TRUE(found());
  EXPECT_EQ(*found(), 1.5);
}

TEST_F(Girth, AWideFigureIsWidenedByLess) {
  show_girth(1.4);
  subject_->set_girth(1.25);
  ASSERT_TRUE(found());
  EXPECT_NEAR(*found() + 0.05, 1.4, 0.05);
  subject_->set_girth(1.35);
  EXPECT_FALSE(found());
}

TEST_F(Girth, IsUnknownTowardsTheCameraAndWithoutATrack) {
  show_girth(1.4, {3, 0.3, 1});
  EXPECT_FALSE(found());
  show_girth(1.4);
  for (FrameRecord& record : records_) record.tracked = false;
  EXPECT_FALSE(found());
  records_.clear();
  EXPECT_FALSE(found());
}

TEST_F(Girth, ThatASceneStatesIsNotEstimated) {
  show_girth(1.4);
  EXPECT_TRUE(subject_->wants_girth());
  subject_->scene.girth_known = true;
  EXPECT_FALSE(subject_->wants_girth());
  show(0.2, kFrames, {{0, -3, 1}, {3, 0, 1}});
  EXPECT_FALSE(subject_->wants_girth()) << "two cameras";
}

}  // namespace
}  // namespace walktrack
