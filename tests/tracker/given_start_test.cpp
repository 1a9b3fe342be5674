// A start at a walk that the scene states: it is a walk like one that is found, near the stated
// place to MotionConfig::given_position_sd.
#include <gtest/gtest.h>

#include "tracker/tracker.h"
#include "walked_scene.h"

namespace walktrack {
namespace {

class GivenStart : public WalkedScene {
 protected:
  // Somebody who is seen from these places, and a walk that is stated.
  void show_given(const DetectedWalk& given, const std::vector<Eigen::Vector3d>& places) {
    show(0.2, kVideoFrames, places);
    subject_->scene.initial = given;
    subject_->scene.initial->given = true;
  }
  std::vector<FrameRecord> tracked() {
    tracker_.emplace(subject_->scene, prior_, subject_->config, 1, 1);
    std::vector<FrameRecord> out;
    const auto keep = [&](std::vector<FrameRecord> more) {
      for (FrameRecord& record : more) out.push_back(std::move(record));
    };
    for (const SceneEvidence& frame : window_) keep(tracker_->push(frame));
    keep(tracker_->finish());
    EXPECT_EQ(out.size(), window_.size());
    return out;
  }
  // Distance of the pelvis from the truth on the ground, mean over all frames, m.
  double error(const std::vector<FrameRecord>& records) const {
    double sum = 0;
    for (size_t i = 0; i < records.size(); ++i) {
      EXPECT_TRUE(records[i].tracked) << i;
      sum += (records[i].estimate.pose.root - poses_[i].root).head<2>().norm();
    }
    return sum / double(records.size());
  }
  DetectedWalk beside(double metres) const {
    DetectedWalk out = walk_;
    out.position.y() += metres;
    return out;
  }
  std::optional<Tracker> tracker_;
};

// Between the stated place and the one that the images show.
TEST_F(GivenStart, IsAsUncertainAsItIsSaidToBe) {
  show_given(beside(0.2), {{0, -4, 1}});
  WalkSearch search;
  for (const SceneEvidence& frame : window_) search.push(frame);
  const auto moved_by = [&](double sd) {
    subject_->config.motion.given_position_sd = sd;
    subject_->model = SubjectModel(subject_->scene.model, prior_, subject_->config.motion, kDt);
    const DetectedWalk& given = *subject_->scene.initial;
    const std::optional<LastSeen> never;
    return (search.nearest_to(subject_->context(), {0, never}, given).position - given.position)
        .norm();
  };
  EXPECT_LT(moved_by(0.001), 0.02);
  EXPECT_GT(moved_by(0.3), 0.1);
}

TEST_F(GivenStart, StaysOneWhileTheHeightIsEstimated) {
  show_given(beside(0.2), {{0, -4, 1}, {4, -1, 1}});
  WalkSearch search;
  for (const SceneEvidence& frame : window_) search.push(frame);
  const std::optional<LastSeen> never;
  const TrackContext context = subject_->context();
  const DetectedWalk near = search.nearest_to(context, {0, never}, *context.scene.initial);
  EXPECT_TRUE(near.given);
  EXPECT_NE(near.position, context.scene.initial->position);
  EXPECT_TRUE(search.with_size(context, {0, never}, near).walk.given);
}

TEST_F(GivenStart, MovesToWhereTheImagesShowTheSubject) {
  show_given(beside(0.2), {{0, -4, 1}, {4, -1, 1}});
  EXPECT_LT(error(tracked()), 0.03);
}

TEST_F(GivenStart, IsFollowedByAFigureAsWideAsTheSubject) {
  girth_ = 1.4;
  show_given(walk_, {{0, -3, 1}});
  EXPECT_LT(error(tracked()), 0.08);
  ASSERT_TRUE(tracker_->estimates().girth);
  EXPECT_NEAR(*tracker_->estimates().girth + 0.05, girth_, 0.1);  // as in girth_test.cpp
}

TEST_F(GivenStart, TheWalkIsSearchedIfNobodyIsThere) {
  DetectedWalk elsewhere = walk_;
  elsewhere.position = {1.6, 1.6};  // too far for a climb
  show_given(elsewhere, {{0, -4, 1}, {4, -1, 1}});
  for (const size_t frames : {kVideoFrames, size_t{20}}) {  // after 20 a track is not lost yet
    window_.resize(frames);
    EXPECT_LT(error(tracked()), 0.05) << frames;
  }
}

TEST_F(GivenStart, AVideoThatIsShorterThanTheWindowIsTracked) {
  show_given(walk_, {{0, -4, 1}, {4, -1, 1}});
  for (const size_t frames : {20, 8, 2}) {
    window_.resize(frames);
    EXPECT_LT(error(tracked()), 0.05) << frames;
  }
}

// The labels of the legs of one camera come from the images.
TEST_F(GivenStart, OneCameraKeepsTheImagesOfItsFrames) {
  for (const bool one : {true, false}) {
    show_given(walk_, {{0, -4, 1}, {4, -1, 1}});
    if (one) subject_->scene.cameras.resize(1);
    const Tracker tracker(subject_->scene, prior_, subject_->config, 1, 1);
    EXPECT_EQ(tracker.wants_picture(), one);
    subject_->scene.initial_frame = 3;
    const Tracker later(subject_->scene, prior_, subject_->config, 1, 1);
    EXPECT_FALSE(later.wants_picture()) << "of frames before the walk";
  }
}

}  // namespace
}  // namespace walktrack
