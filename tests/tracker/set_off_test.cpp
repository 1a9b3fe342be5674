// Somebody before two cameras who stands and then walks: other moments of setting off are tried.
#include "tracker/start/set_off.h"

#include <algorithm>
#include <utility>

#include <gtest/gtest.h>

#include "tracker/detect/standing_start.h"
#include "walked_scene.h"

namespace walktrack {
namespace {

class SetOff : public WalkedScene {
 protected:
  static constexpr size_t kStands = 30, kWalks = 40;
  static constexpr double kPhase = 0.05;  // of the stride when they set off

  SetOff() {
    show(kPhase, kWalks, {{0, -4, 1}, {4, -1, 1.5}});
    TrackerScene& scene = subject_->scene;
    Pose standing = standing_pose(scene.model);
    standing.root.head<2>() = walk_.position;
    SceneEvidence still;
    for (const Camera& camera : scene.cameras)
      still.push_back(evidence_of(camera, scene.model.body, standing));
    window_.insert(window_.begin(), kStands, still);
    subject_->config.filter.particles = 80;
    subject_->config.start.particles = 50;
  }

  // All frames, by particles that stand at first, or in a walk.
  Attempt attempt(bool stands) {
    const TrackContext context = subject_->context();
    DetectedWalk walk = walk_;
    walk.standing = stands;
    Searching before{WalkerFilter(subject_->config.filter, 1, 1), {}};
    Attempt out{.mode = start_around(context, walk, phase_ranges(subject_->config.start, kPhase), 1,
                                     std::move(before))};
    follow_rest(window(context), out);
    return out;
  }
  WindowFrames window(const TrackContext& context) const { return {context, window_, 0}; }

  // As if the images had less evidence for it after the subject sets off.
  static void spoil(Attempt& attempt) {
    for (size_t i = attempt.sets_off; i < attempt.records.size(); ++i)
      attempt.records[i].mean_log_likelihood -= 1000;
  }

  // Of the pelvis from the truth on the ground in the last frame, m.
  double error(const Attempt& attempt) const {
    const DetectedWalk truth = moved(walk_, kDt * double(kWalks - 1));
    return (attempt.records.back().estimate.pose.root.head<2>() - truth.position).norm();
  }
};

TEST_F(SetOff, IsSeenAndTheMomentsBeforeAreKept) {
  const Attempt first = attempt(true);
  ASSERT_EQ(first.records.size(), kStands + kWalks);
  EXPECT_GT(first.sets_off, kStands - 3);
  EXPECT_LT(first.sets_off, kStands + 15);
  ASSERT_GE(first.stood.size(), 3u);
  for (size_t i = 0; i < first.stood.size(); ++i) {
    EXPECT_LT(first.stood[i].after, first.sets_off);
    if (i > 0) {
      EXPECT_GE(first.stood[i].after, first.stood[i - 1].after + 4);
    }
  }
}

TEST_F(SetOff, AnotherMomentReplacesOneThatExplainsTheImagesWorse) {
  Attempt first = attempt(true);
  const std::vector<FrameRecord> records = first.records;
  const size_t earliest = first.stood.front().after;
  spoil(first);
  const double before = total_log_likelihood(first);
  const Attempt best = with_best_set_off(window(subject_->context()), std::move(first));
  ASSERT_EQ(best.records.size(), records.size());
  EXPECT_GT(total_log_likelihood(best), before + 1000);
  for (size_t i = 0; i < earliest; ++i)
    EXPECT_EQ(best.records[i].mean_log_likelihood, records[i].mean_log_likelihood) << i;
  EXPECT_LT(best.records.back().modes.standing, 0.5);
  EXPECT_LT(error(best), 0.1);
}

TEST_F(SetOff, TheBestTrackStays) {
  Attempt first = attempt(true);
  for (FrameRecord& record : first.records) record.mean_log_likelihood += 1000;
  const double before = total_log_likelihood(first);
  const Attempt best = with_best_set_off(window(subject_->context()), std::move(first));
  EXPECT_EQ(total_log_likelihood(best), before);
}

TEST_F(SetOff, SomebodyWhoWalksFromTheBeginningDoesNot) {
  window_.erase(window_.begin(), window_.begin() + kStands);
  Attempt walking = attempt(false);
  EXPECT_EQ(walking.sets_off, 0u);
  spoil(walking);
  const double before = total_log_likelihood(walking);
  const Attempt same = with_best_set_off(window(subject_->context()), std::move(walking));
  EXPECT_EQ(total_log_likelihood(same), before);
}

}  // namespace
}  // namespace walktrack
