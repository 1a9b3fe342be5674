// Somebody before two cameras who stands and then walks: other moments of setting off are tried.
#include "tracker/start/set_off.h"

#include <algorithm>
#include <utility>

#include <gtest/gtest.h>

#include "tracker/detect/standing_start.h"
#include "tracker/start/new_start.h"
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

  // All frames, or the first of them, by particles that stand at first, or in a walk.
  Attempt attempt(bool stands, size_t frames = kStands + kWalks) {
    const TrackContext context = subject_->context();
    DetectedWalk walk = walk_;
    walk.standing = stands;
    Searching before{WalkerFilter(subject_->config.filter, 1, 1), {}};
    Attempt out{.mode = start_around(context, walk, phase_ranges(subject_->config.start, kPhase), 1,
                                     std::move(before))};
    follow_rest(window(context), out, frames);
    return out;
  }
  // The same, as the newest frames of a track, from number `first` on; `mode` is the track.
  HeldFrames held(uint32_t first, size_t frames, TrackMode& mode) {
    Attempt all = attempt(true, frames);
    HeldFrames out = held_start(subject_->context(), first, std::move(all.records), false);
    out.stood = std::move(all.stood);
    mode = std::move(all.mode);
    return out;
  }
  WindowFrames window(const TrackContext& context) const { return {context, window_, 0}; }

  // As if the images had less evidence for it after the subject sets off.
  static void spoil(Attempt& attempt) {
    for (size_t i = attempt.stood.sets_off; i < attempt.records.size(); ++i)
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
  EXPECT_GT(first.stood.sets_off, kStands - 3);
  EXPECT_LT(first.stood.sets_off, kStands + 15);
  ASSERT_GE(first.stood.newest.size(), 3u);
  for (size_t i = 0; i < first.stood.newest.size(); ++i) {
    EXPECT_LT(first.stood.newest[i].after, first.stood.sets_off);
    if (i > 0) {
      EXPECT_GE(first.stood.newest[i].after, first.stood.newest[i - 1].after + 4);
    }
  }
}

TEST_F(SetOff, AnotherMomentReplacesOneThatExplainsTheImagesWorse) {
  Attempt first = attempt(true);
  const std::vector<FrameRecord> records = first.records;
  const size_t earliest = first.stood.newest.front().after;
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
  EXPECT_EQ(walking.stood.sets_off, 0u);
  spoil(walking);
  const double before = total_log_likelihood(walking);
  const Attempt same = with_best_set_off(window(subject_->context()), std::move(walking));
  EXPECT_EQ(total_log_likelihood(same), before);
}

TEST_F(SetOff, OfFramesThatAreHeldBackIsTriedFromOtherMoments) {
  TrackMode mode = Searching{WalkerFilter(subject_->config.filter, 1, 1), {}};
  HeldFrames frames = held(0, kStands + kWalks, mode);
  const size_t sets_off = frames.stood.sets_off;
  std::vector<double> before;
  for (size_t i = 0; i < frames.records.size(); ++i) {
    if (i >= sets_off) frames.records[i].mean_log_likelihood -= 1000;
    before.push_back(frames.records[i].mean_log_likelihood);
  }
  std::get<Tracking>(mode).held = std::move(frames);
  subject_->config.start.seconds = 10;  // too few frames for a new start
  uint32_t starts = 1;
  const auto records = decide_held(subject_->context(), window_, true, starts, mode);
  ASSERT_EQ(records.size(), kStands + kWalks) << "who walks is not held back further";
  EXPECT_FALSE(holding(mode));
  EXPECT_EQ(starts, 1u);
  double gained = 0;
  for (size_t i = 0; i < records.size(); ++i) gained += records[i].mean_log_likelihood - before[i];
  EXPECT_GT(gained, 1000);
}

// More frames are held back when the subject sets off.
TEST_F(SetOff, IsSeenToItsEnd) {
  const TrackContext context = subject_->context();
  TrackMode mode = Searching{WalkerFilter(subject_->config.filter, 1, 1), {}};
  HeldFrames frames = held(0, kStands, mode);
  frames.until = kStands + 1;
  std::get<Tracking>(mode).held = std::move(frames);
  size_t t = kStands;
  for (; t < window_.size() && std::get<Tracking>(mode).held->stood.sets_off == 0; ++t)
    follow(context, window_[t], static_cast<uint32_t>(t), mode);
  ASSERT_LT(t, window_.size());
  EXPECT_EQ(std::get<Tracking>(mode).held->until, t + frames_in(1.25, kDt));
}

TEST_F(SetOff, MayFollowSoThatFramesOfStandingAreHeldBackFurther) {
  const TrackContext context = subject_->context();
  const size_t kept = static_cast<size_t>(frames_in(0.9, kDt));
  TrackMode mode = Searching{WalkerFilter(subject_->config.filter, 1, 1), {}};
  uint32_t starts = 1;
  const HeldFrames frames = held(5, kStands, mode);
  std::get<Tracking>(mode).held = frames;
  const std::deque<SceneEvidence> shown(window_.begin(), window_.begin() + kStands);
  ASSERT_EQ(decide_held(context, shown, true, starts, mode).size(), kStands - kept);
  const HeldFrames& still = *std::get<Tracking>(mode).held;
  EXPECT_EQ(still.first, 5 + kStands - kept);
  EXPECT_EQ(still.records.size(), kept);
  EXPECT_FALSE(still.enough());
  ASSERT_FALSE(still.stood.newest.empty());
  EXPECT_EQ(still.stood.newest.back().after, frames.stood.newest.back().after - (kStands - kept));
  EXPECT_EQ(still.stood.newest.back().track, frames.stood.newest.back().track);
  EXPECT_EQ(decide_held(context, shown, false, starts, mode).size(), kept) << "at the end";
}

// Otherwise there would be no checkpoint for as long as somebody stands.
TEST_F(SetOff, LetsGoOfStandingEveryTenSeconds) {
  const auto ten_seconds = static_cast<uint32_t>(frames_in(10, kDt));
  TrackMode mode = Searching{WalkerFilter(subject_->config.filter, 1, 1), {}};
  HeldFrames frames = held(0, kStands, mode);
  for (const auto& [first, kept] : {std::pair{0u, true},
                                    {ten_seconds - uint32_t{kStands}, false},
                                    {ten_seconds - 1, false},
                                    {ten_seconds, true}}) {
    frames.first = first;
    EXPECT_EQ(frames_to_keep(subject_->context(), frames) > 0, kept) << first;
  }
}

}  // namespace
}  // namespace walktrack
