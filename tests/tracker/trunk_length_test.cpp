#include "tracker/figure/trunk_length.h"

#include <vector>

#include <gtest/gtest.h>

#include "walked_scene.h"

namespace walktrack {
namespace {

// Somebody whose trunk is longer by so much than usual walks past one camera; the true poses are
// the records of a start.
class TrunkLength : public WalkedScene {
 protected:
  static constexpr size_t kFrames = 12;
  void show_longer(double metres) {
    longer_ = metres;
    show(0.2, kFrames, {{0, -3, 1}});
    records_.assign(kFrames, {});
    for (size_t t = 0; t < kFrames; ++t) {
      records_[t].tracked = true;
      records_[t].estimate.pose = poses_[t];
    }
  }
  double usual() const { return test_model().body.lengths.trunk; }
  std::optional<double> found() const { return other_trunk({subject_->scene, window_, records_}); }
  std::vector<FrameRecord> records_;
};

TEST_F(TrunkLength, OfSomebodyWhoStoopsOrHasLongLegsIsFoundAndNotOfOthers) {
  for (const double longer : {-0.1, -0.06, 0.04}) {
    show_longer(longer);
    ASSERT_TRUE(found()) << longer;
    EXPECT_NEAR(*found() - usual(), longer, 0.01);
  }
  for (const double longer : {-0.04, 0.0, 0.015}) {
    show_longer(longer);
    EXPECT_FALSE(found()) << longer;
  }
}

TEST_F(TrunkLength, DiffersByNoMoreThanTwelveCentimetres) {
  for (const double longer : {-0.135, -0.2}) {
    show_longer(longer);
    ASSERT_TRUE(found()) << longer;
    EXPECT_NEAR(*found() - usual(), -0.12, 1e-9) << longer;
  }
}

TEST_F(TrunkLength, OfAFigureThatHasAnotherOneIsImproved) {
  show_longer(-0.1);
  subject_->set_trunk(usual() - 0.06);
  ASSERT_TRUE(found());
  EXPECT_NEAR(*found() - usual(), -0.1, 0.01);
  subject_->set_trunk(usual() - 0.09);
  EXPECT_FALSE(found());
  subject_->set_trunk(std::nullopt);
  EXPECT_EQ(subject_->scene.model.body.lengths.trunk, usual());
}

TEST_F(TrunkLength, IsUnknownWithoutATrack) {
  show_longer(-0.1);
  for (FrameRecord& record : records_) record.tracked = false;
  EXPECT_FALSE(found());
  records_.clear();
  EXPECT_FALSE(found());
}

TEST_F(TrunkLength, IsEstimatedOnlyBeforeOneCameraOfASubjectOfKnownHeight) {
  show_longer(0);
  EXPECT_TRUE(subject_->wants_trunk());
  subject_->scene.trunk_known = true;
  EXPECT_FALSE(subject_->wants_trunk());
  show_longer(0);
  subject_->scene.size_known = false;
  EXPECT_FALSE(subject_->wants_trunk());
  show_longer(0);
  subject_->let_keypoints_lead();
  EXPECT_FALSE(subject_->wants_trunk());
  show(0.2, kFrames, {{0, -3, 1}, {3, 0, 1}});
  EXPECT_FALSE(subject_->wants_trunk()) << "two cameras";
}

}  // namespace
}  // namespace walktrack
