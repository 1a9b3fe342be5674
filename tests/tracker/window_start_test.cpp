#include "tracker/start/window_start.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace walktrack
