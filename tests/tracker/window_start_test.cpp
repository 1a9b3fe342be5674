#include "tracker/start/window_start.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "tracker/start/trial.h"
#include "tracker/tracker.h"
#include "walked_scene.h"

namespace walktrack {
namespace {

class WindowStartTest : public WalkedScene {
 protected:
  std::optional<WindowStart> start() {
    WalkSearch search;
    TrackMode mode = Searching{WalkerFilter(subject_->config.filter, 1, 1), {}};
    uint32_t first = 0;
    for (const SceneEvidence& frame : window_) {
      search.push(frame);
      if (!search.lasts(subject_->config.detector.window, kDt)) continue;
      auto started = start_in_window(*subject_, search, first, starts_, mode);
      EXPECT_EQ(started.has_value(), !is_searching(mode));
      if (started) return started;
      search.slide(subject_->context());
      ++first;
    }
    return std::nullopt;
  }
  // Distance of the pelvis from the truth on the ground, mean over the frames, m.
  double error(const WindowStart& start) const {
    double sum = 0;
    for (size_t i = 0; i < start.records.size(); ++i) {
      const DetectedWalk truth = moved(walk_, kDt * double(start.first_frame + i));
      sum += (start.records[i].estimate.pose.root.head<2>() - truth.position).norm();
    }
    return sum / double(std::max<size_t>(1, start.records.size()));
  }
  uint32_t starts_ = 0;
};

TEST_F(WindowStartTest, SomebodyWhoIsVisibleIsTriedOnce) {
  show(0.2, kVideoFrames, {{0, -4, 1}});
  const auto started = start();
  ASSERT_TRUE(started);
  EXPECT_EQ(starts_, 1u);
  EXPECT_EQ(started->first_frame, 0u);
  EXPECT_LT(error(*started), 0.03);
}

// Of people in front of a camera the best of six figures in each frame fits as well as a walker.
TEST_F(WindowStartTest, ATrialMayExplainALittleLessThanTheDetectedWalk) {
  struct Case {
    double times;  // so many times the trial explains, the detected walk does
    bool tracks;
  };
  show(0.2, kVideoFrames, {{0, -4, 1}});
  const Searching before{WalkerFilter(subject_->config.filter, 1, 1), {}};
  const auto tried = [&](double score) {
    DetectedWalk walk = walk_;
    walk.score = score;
    return try_start(subject_->context(), window_, 0, walk, 1, before);
  };
  const double found = tried(0).log_likelihood / double(window_.size());
  ASSERT_GT(found, 0);
  for (const Case& each : {Case{1.04, true}, Case{1.1, false}})
    EXPECT_EQ(is_tracking(tried(each.times * found).mode), each.tracks) << each.times;
}

// With the other walk the errors would be 12 and 4 cm.
TEST_F(WindowStartTest, OfSomebodyWhoWasHalfHiddenTheBetterOfTwoWalksIsTaken) {
  struct Case {
    double phase;
    int column;
    double error;  // m
  };
  for (const Case& tried : {Case{0.2, 128, 0.08}, Case{0.4, 120, 0.03}}) {
    SCOPED_TRACE(tried.column);
    show_coming_out(tried.phase, tried.column);
    starts_ = 0;
    const auto started = start();
    ASSERT_TRUE(started);
    EXPECT_EQ(starts_, 2u);
    EXPECT_LE(started->first_frame, kHiddenFrames);
    EXPECT_EQ(started->untracked, started->first_frame);
    EXPECT_LT(error(*started), tried.error);
  }
}

// A search does not look at every window, but goes back when it has found somebody.
TEST_F(WindowStartTest, ATrackBeginsWhereASearchOfEveryWindowFindsTheWalk) {
  for (const size_t empty : {0, 4}) {
    SCOPED_TRACE(empty);
    show(0.2, kVideoFrames + empty, {{0, -4, 1}}, [empty](size_t frame, CameraEvidence& evidence) {
      if (frame < empty) hide_left_of(kEvidenceWidth, evidence);
    });
    Tracker tracker(subject_->scene, prior_, subject_->config, 1, 1);
    std::vector<FrameRecord> records;
    const auto keep = [&](std::vector<FrameRecord> more) {
      for (FrameRecord& record : more) records.push_back(std::move(record));
    };
    for (const SceneEvidence& frame : window_) keep(tracker.push(frame));
    keep(tracker.finish());
    ASSERT_EQ(records.size(), window_.size());
    const auto tracked = [](const FrameRecord& record) { return record.tracked; };
    const auto begin = std::find_if(records.begin(), records.end(), tracked);
    const auto started = start();
    ASSERT_TRUE(started);
    EXPECT_EQ(static_cast<size_t>(begin - records.begin()), started->first_frame);
  }
}

TEST_F(WindowStartTest, OneCameraWeighsTheFramesOfAStartAtTheSubjectsDistance) {
  for (const bool one : {true, false}) {
    show(0.2, kVideoFrames, {{0, -4, 1}, {4, -1, 1}});
    if (one) subject_->scene.cameras.resize(1);
    for (SceneEvidence& frame : window_) {
      frame.resize(subject_->scene.cameras.size());
      for (CameraEvidence& evidence : frame) evidence.pixel_weight = 0.2;
    }
    const auto started = start();
    ASSERT_TRUE(started);
    for (const SceneEvidence& frame : started->frames)
      EXPECT_NEAR(frame[0].pixel_weight, one ? 0.04 : 0.2, 0.002) << one;
  }
}

TEST_F(WindowStartTest, BeforeOneCameraAWidePersonIsTriedAgainWithAWiderFigure) {
  girth_ = 1.4;
  show(0.2, kVideoFrames, {{0, -3, 1}});
  const auto started = start();
  ASSERT_TRUE(started);
  EXPECT_GE(starts_, 2u);
  ASSERT_TRUE(subject_->estimates().girth);
  EXPECT_NEAR(*subject_->estimates().girth + 0.05, girth_, 0.1);  // as in girth_test.cpp
  EXPECT_EQ(subject_->scene.model.body.subject.girth, *subject_->estimates().girth);
  EXPECT_LT(error(*started), 0.08);
}

TEST_F(WindowStartTest, BeforeOneCameraAShortTrunkIsTriedAgainWithAShorterFigure) {
  longer_ = -0.1;
  std::vector<double> errors;
  for (const bool trunk_known : {false, true}) {
    show(0.2, kVideoFrames, {{0, -3, 1}});
    subject_->scene.trunk_known = trunk_known;
    starts_ = 0;
    const auto started = start();
    ASSERT_TRUE(started);
    EXPECT_EQ(starts_ > 1, !trunk_known);
    errors.push_back(error(*started));
    if (trunk_known) continue;
    const Body& body = subject_->scene.model.body;
    ASSERT_TRUE(subject_->estimates().trunk);
    EXPECT_EQ(body.lengths.trunk, *subject_->estimates().trunk);
    // A change of less than 2 cm is not tried any more.
    EXPECT_NEAR(body.lengths.trunk - test_model().body.lengths.trunk, longer_, 0.03);
  }
  EXPECT_LT(errors[0], 0.04);
  EXPECT_GT(errors[1], 2 * errors[0]);
}

TEST_F(WindowStartTest, ATrackThatIsResumedKeepsItsShape) {
  girth_ = 1.4;
  longer_ = -0.1;
  show(0.2, 2 * kVideoFrames, {{0, -3, 1}});
  Tracker tracker(subject_->scene, prior_, subject_->config, 1, 1);
  for (const SceneEvidence& frame : window_)
    if (!tracker.has_state()) tracker.push(frame);
  ASSERT_TRUE(tracker.has_state());
  ASSERT_TRUE(tracker.estimates().girth);
  Tracker other(subject_->scene, prior_, subject_->config, 1, 1);
  other.resume(tracker.state());
  EXPECT_EQ(other.estimates().girth, tracker.estimates().girth);
  EXPECT_EQ(other.body().subject.girth, tracker.estimates().girth);
  ASSERT_TRUE(tracker.estimates().trunk);
  EXPECT_EQ(other.estimates().trunk, tracker.estimates().trunk);
  EXPECT_EQ(other.body().lengths.trunk, tracker.estimates().trunk);
}

TEST_F(WindowStartTest, TheGirthOfAUsualPersonIsDecidedByTheFirstStart) {
  show(0.2, kVideoFrames, {{0, -4, 1}});
  EXPECT_TRUE(subject_->wants_girth());
  ASSERT_TRUE(start());
  EXPECT_FALSE(subject_->estimates().girth);
  EXPECT_FALSE(subject_->wants_girth());
}

// As if no other figure had been tried.
TEST_F(WindowStartTest, SomebodyWhoIsALittleWideKeepsTheStartOfTheUsualFigure) {
  girth_ = 1.25;
  for (const bool height_known : {true, false}) {
    SCOPED_TRACE(height_known);
    std::vector<WindowStart> found;
    std::vector<double> heights;
    for (const bool girth_known : {true, false}) {
      show(0.2, kVideoFrames, {{0, -3, 1}});
      subject_->scene.girth_known = girth_known;
      subject_->scene.size_known = height_known;
      starts_ = 0;
      auto started = start();
      ASSERT_TRUE(started);
      EXPECT_EQ(starts_ > 1, !girth_known) << "a wider figure is tried";
      EXPECT_FALSE(subject_->estimates().girth);
      EXPECT_EQ(subject_->scene.model.body.subject.girth, 1);
      EXPECT_EQ(subject_->stature.has_value(), !height_known);
      heights.push_back(subject_->scene.model.body.subject.height);
      found.push_back(*std::move(started));
    }
    EXPECT_EQ(heights[0], heights[1]);
    EXPECT_EQ(found[0].first_frame, found[1].first_frame);
    EXPECT_EQ(found[0].frames.size(), found[1].frames.size());
    ASSERT_EQ(found[0].records.size(), found[1].records.size());
    for (size_t i = 0; i < found[0].records.size(); ++i)
      EXPECT_EQ(found[0].records[i].estimate.pose.root, found[1].records[i].estimate.pose.root);
  }
}

TEST_F(WindowStartTest, AGirthThatTheSceneStatesStays) {
  girth_ = 1.4;
  show(0.2, kVideoFrames, {{0, -3, 1}});
  subject_->scene.girth_known = true;
  ASSERT_TRUE(start());
  EXPECT_FALSE(subject_->estimates().girth);
  EXPECT_EQ(subject_->scene.model.body.subject.girth, 1);
}

// Somebody who stands for a while and then walks, at the side of the first camera.
class StandingFirst : public WindowStartTest {
 protected:
  static constexpr uint32_t kStood = 12;
  static constexpr double kStrong = 9;  // outlines that count for a ninth still suffice
  // `times`: the evidence while they stand, as a multiple of that while they walk.
  void show_standing_first(const std::vector<Eigen::Vector3d>& places, double times) {
    show(0.2, kVideoFrames, places);
    const auto strengthen = [](double factor, CameraEvidence& evidence) {
      for (int32_t& sum : evidence.planes.prefix)
        sum = static_cast<int32_t>(std::lround(factor * sum));
    };
    for (SceneEvidence& frame : window_)
      for (CameraEvidence& evidence : frame) strengthen(kStrong, evidence);
    Pose standing = standing_pose(subject_->scene.model);
    standing.root.head<2>() = walk_.position;
    for (size_t t = 0; t < kStood; ++t) {
      SceneEvidence& frame = window_.emplace_front();
      for (const Camera& camera : subject_->scene.cameras) {
        frame.push_back(evidence_of(camera, subject_->scene.model.body, standing));
        strengthen(times * kStrong, frame.back());
      }
    }
  }
  // A start with the frames in which they walk.
  std::optional<WindowStart> started() {
    WalkSearch search;
    for (const SceneEvidence& frame : window_) search.push(frame);
    search.let_go(kStood);
    TrackMode mode = Searching{WalkerFilter(subject_->config.filter, 1, 1), {}};
    return start_in_window(*subject_, search, kStood, starts_, mode);
  }
  // The weight of the pixels while they stand, as a share of that when they begin to walk.
  static double still_share(const WindowStart& start) {
    return start.frames[0][0].pixel_weight / start.frames[kStood][0].pixel_weight;
  }
};

TEST_F(StandingFirst, TheirOutlinesCountLessBeforeOneCameraWhereKeypointsLead) {
  struct Case {
    bool one, lead;
    double share;
  };
  for (const Case& tried : {Case{true, true, 0.1}, {true, false, 1}, {false, true, 1}}) {
    SCOPED_TRACE(testing::Message() << tried.one << tried.lead);
    std::vector<Eigen::Vector3d> places{{0, -4, 1}};
    if (!tried.one) places.emplace_back(4, -1, 1);
    show_standing_first(places, 1);
    if (tried.lead) subject_->let_keypoints_lead();
    const auto start = started();
    ASSERT_TRUE(start);
    EXPECT_EQ(start->first_frame, 0u);
    EXPECT_NEAR(still_share(*start), tried.share, 0.05 * tried.share);
  }
}

// A tenth of so little evidence shows nobody.
TEST_F(StandingFirst, TheyAreFoundByAllOfTheirOutlinesIfLessShowsNobody) {
  show_standing_first({{0, -4, 1}}, 0.06);
  subject_->let_keypoints_lead();
  const auto start = started();
  ASSERT_TRUE(start);
  EXPECT_EQ(start->first_frame, 0u);
  EXPECT_NEAR(still_share(*start), 1, 0.05);
}

}  // namespace
}  // namespace walktrack
