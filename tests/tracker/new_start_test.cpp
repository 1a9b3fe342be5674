// A track before two cameras whose legs may be swapped is tracked once more from a new start.
#include "tracker/start/new_start.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include <gtest/gtest.h>

#include "core/log_weights.h"
#include "tracker/moves/mirror_legs.h"
#include "tracker/overlaps.h"
#include "tracker/tracker.h"
#include "walked_scene.h"

namespace walktrack {
namespace {

class NewStart : public WalkedScene {
 protected:
  static constexpr size_t kFrames = 60;
  static constexpr double kPhase = 0.2;  // of the stride in the first frame

  NewStart() {
    show(kPhase, kFrames + 1, {{0, -4, 1}, {4, -1, 1.5}});
    next_ = window_.back();
    window_.pop_back();
    subject_->config.filter.particles = 80;
    subject_->config.start.particles = 50;
  }

  TrackContext context() const { return subject_->context(); }

  // A track of all frames that are shown, all of them held back.
  TrackMode track(bool legs_in_doubt, bool mirrored_legs) {
    const size_t first = size_t(frames_in(subject_->config.start.seconds, kDt));
    Searching before{WalkerFilter(subject_->config.filter, 1, 1), {}};
    TrackContext own = context();
    own.competing = false;  // until the frames are held below
    TrackMode mode = start_around(own, walk_, phase_ranges(subject_->config.start, kPhase), 1,
                                  std::move(before));
    std::vector<FrameRecord> records;
    for (size_t t = 0; t < kFrames; ++t) {
      for (FrameRecord& record : follow(own, window_[t], static_cast<uint32_t>(t), mode))
        records.push_back(std::move(record));
      if (t + 1 == first && mirrored_legs) {
        for (FrameRecord& record : records) mirror_legs(own.body(), record);
        mirror_legs(filter_context(own).motion, std::get<Tracking>(mode).filter);
      }
    }
    std::get<Tracking>(mode).held = held_start(context(), 0, std::move(records), legs_in_doubt);
    return mode;
  }

  // Share of the records that are in the wrong half of the stride.
  double swapped(const std::vector<FrameRecord>& records) const {
    const PriorGait gait = usual_gait(subject_->scene.model, prior_, kSpeed, 0);
    double count = 0;
    for (size_t t = 0; t < records.size(); ++t)
      count += apart(records[t].modes.phase, kPhase + double(t) * kDt / (2 * gait.period));
    return count / double(records.size());
  }

  SceneEvidence next_;  // of the frame after those
  uint32_t starts_ = 1;
};

TEST_F(NewStart, ReplacesATrackWhoseLegsAreSwapped) {
  TrackMode mode = track(true, true);
  EXPECT_GT(swapped(std::get<Tracking>(mode).held->records), 0.5);
  const auto records = decide_held(context(), window_, false, starts_, mode);
  ASSERT_EQ(records.size(), kFrames);
  EXPECT_LT(swapped(records), 0.05);
  EXPECT_FALSE(holding(mode));
  ASSERT_TRUE(is_tracking(mode));
  const auto& set = std::get<Tracking>(mode).filter.particles();
  const double phase = stride_modes(set.states, normalised_weights(set.log_weights)).phase;
  EXPECT_NEAR(std::remainder(phase - records.back().modes.phase, 1.0), 0, 0.05)
      << "the next frame continues with the better track";
}

TEST_F(NewStart, IsNotTriedWithoutDoubt) {
  TrackMode mode = track(false, true);
  const double before = swapped(std::get<Tracking>(mode).held->records);
  EXPECT_EQ(swapped(decide_held(context(), window_, false, starts_, mode)), before);
  EXPECT_EQ(starts_, 1u);
}

// Nothing switches, but the overlap is lower than it was before the frames that are held.
TEST_F(NewStart, IsTriedWhenTheOverlapFalls) {
  TrackMode mode = track(false, true);
  std::get<Tracking>(mode).monitor.fits.assign(60, {{1, 1}, {1, 1}, 0});
  EXPECT_LT(swapped(decide_held(context(), window_, false, starts_, mode)), 0.05);
  EXPECT_GT(starts_, 1u);
  EXPECT_EQ(std::get<Tracking>(mode).monitor.fits.size(), frames_of_fall(kDt));
}

TEST_F(NewStart, LeavesARightTrackRight) {
  TrackMode mode = track(true, false);
  EXPECT_LT(swapped(decide_held(context(), window_, false, starts_, mode)), 0.05);
  EXPECT_EQ(starts_, 2u);  // a second new start could not gain anything either
}

// Somebody who stands has no phase, so that a new start begins after that.
TEST_F(NewStart, BeginsWhereTheSubjectHasStood) {
  constexpr size_t kStands = 12;
  TrackMode mode = track(true, true);
  std::vector<FrameRecord>& held = std::get<Tracking>(mode).held->records;
  for (size_t t = 0; t < kStands; ++t) held[t].modes = {.standing = 1};
  const auto records = decide_held(context(), window_, false, starts_, mode);
  ASSERT_EQ(records.size(), kFrames);
  for (size_t t = 0; t < kStands; ++t) EXPECT_EQ(records[t].modes.standing, 1) << t;
  EXPECT_EQ(records[kStands].modes.standing, 0);
  EXPECT_GT(starts_, 1u);
}

TEST_F(NewStart, BeginsBeforeAShortStop) {
  TrackMode mode = track(true, true);
  std::vector<FrameRecord>& held = std::get<Tracking>(mode).held->records;
  for (size_t t = kFrames - 15; t < kFrames - 6; ++t) held[t].modes.standing = 1;
  const auto records = decide_held(context(), window_, false, starts_, mode);
  EXPECT_GT(starts_, 1u);
  EXPECT_LT(swapped(records), 0.05);
}

// The monitor has lost the track in the last of the held frames.
TEST_F(NewStart, FindsALostTrackAgain) {
  TrackMode mode = track(false, true);
  HeldFrames& held = *std::get<Tracking>(mode).held;
  EXPECT_FALSE(held.enough());
  held.lost = true;
  held.records.back().tracked = false;
  EXPECT_TRUE(held.enough()) << "decided at once";
  const auto records = decide_held(context(), window_, false, starts_, mode);
  EXPECT_TRUE(is_tracking(mode));
  EXPECT_TRUE(records.back().tracked);
  EXPECT_LT(swapped(records), 0.05);
}

TEST_F(NewStart, ALostTrackWithoutABetterStartIsLost) {
  TrackMode mode = track(false, false);
  HeldFrames& held = *std::get<Tracking>(mode).held;
  held.lost = true;
  held.records.back().tracked = false;
  const auto records = decide_held(context(), window_, false, starts_, mode);
  EXPECT_GT(starts_, 1u);
  EXPECT_TRUE(is_searching(mode));
  EXPECT_FALSE(records.back().tracked);
  EXPECT_TRUE(records[kFrames - 2].tracked);
}

TEST_F(NewStart, IsNotTriedInFewFrames) {
  TrackMode mode = track(true, true);
  std::vector<FrameRecord>& held = std::get<Tracking>(mode).held->records;
  for (size_t t = 0; t + 10 < held.size(); ++t) held[t].modes = {.standing = 1};
  EXPECT_EQ(decide_held(context(), window_, false, starts_, mode).size(), kFrames);
  EXPECT_EQ(starts_, 1u);
}

// Most particles have swapped legs, and the images of the next frame prefer the others.
TEST_F(NewStart, IsAskedForWhenTheParticlesSwitchLegs) {
  const auto switched = [&](double mirrored_share) {
    Tracking now = std::get<Tracking>(track(false, false));
    const MotionContext motion = filter_context(context()).motion;
    std::vector<WalkerParticle> states = now.filter.particles().states;
    const auto count = static_cast<size_t>(mirrored_share * double(states.size()));
    for (size_t i = 0; i < count; ++i) mirror_legs(motion, states[i]);
    now.filter.start(std::move(states));
    return filter_frame(context(), filter_context(context()), next_, kFrames, 1, now.filter)
        .legs_switched;
  };
  EXPECT_TRUE(switched(0.6));
  EXPECT_FALSE(switched(0));
}

TEST_F(NewStart, NeedsMoreFramesAfterASwitch) {
  HeldFrames held = held_from(context(), 7);
  const size_t usual = held.until;
  EXPECT_EQ(usual, size_t(frames_in(1.25, kDt)));
  const Tracking now = std::get<Tracking>(track(false, false));
  const auto add = [&](bool switched) {
    FilteredFrame frame;
    frame.legs_switched = switched;
    hold(context(), std::move(frame), now, held);
  };
  for (int i = 0; i < 9; ++i) add(false);
  EXPECT_EQ(held.until, usual);
  add(true);
  EXPECT_TRUE(held.legs_in_doubt);
  EXPECT_EQ(held.until, 10 + usual);
  add(true);
  EXPECT_EQ(held.until, 10 + usual) << "the first one counts, so that it ends";
}

// Frames of a tracker come late, and none is missing; with one camera, and for a walker that makes
// no phase jumps, nothing is held.
TEST_F(NewStart, FramesAreHeldWithSeveralCameras) {
  const auto records_of = [&](const TrackerConfig& config) {
    Tracker tracker(subject_->scene, prior_, config, 1, 1);
    std::vector<size_t> out;
    for (const SceneEvidence& each : window_) out.push_back(tracker.push(each).size());
    out.push_back(tracker.finish().size());
    return out;
  };
  TrackerConfig config = subject_->config;
  const std::vector<size_t> held = records_of(config);
  EXPECT_EQ(std::count(held.begin(), held.end() - 1, 0u), int(kFrames)) << "60 < 36 + 38 frames";
  EXPECT_EQ(held.back(), kFrames);
  config.start_again = false;
  const std::vector<size_t> alone = records_of(config);
  EXPECT_EQ(alone[kFrames - 1], 1u);
}

}  // namespace
}  // namespace walktrack
