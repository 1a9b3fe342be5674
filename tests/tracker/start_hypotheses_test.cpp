#include "tracker/start/start_hypotheses.h"

#include <cmath>

#include <gtest/gtest.h>

#include "fixture.h"
#include "tests/tracker/frame_time.h"

namespace walktrack {
namespace {

// Without evidence hypotheses are not distinguished.
struct Blind {
  Walking walking;
  TrackerScene scene = unseen(walking.model, kDt);
  WalkerFilterContext context{scene, walking.context(kDt), 0, 1};
  StartConfig start;
  FilterConfig filter;
  DetectedWalk detected;

  Blind() {
    start.phases = 3;
    start.particles = 20;
    start.seconds = 0.2;
    filter.particles = 60;
    detected.velocity = {1.2, 0};
  }

  std::vector<PhaseRange> ranges(std::optional<double> stride_phase) const {
    return stride_phase ? phase_ranges(start, *stride_phase) : phase_ranges(start);
  }
  StartHypotheses contest(std::optional<double> stride_phase) const {
    return {context.motion, start, filter, detected, ranges(stride_phase), 5, 1};
  }
};

TEST(StartHypotheses, KeepsHypothesesWithoutEvidence) {
  const Blind blind;
  StartHypotheses contest = blind.contest(std::nullopt);
  uint32_t frame = 0;
  while (!contest.decided()) {
    ASSERT_LT(frame, 100u);
    ASSERT_TRUE(contest.step(blind.context, {}, frame++));
  }
  EXPECT_EQ(contest.frames(), 6);
  EXPECT_EQ(contest.records().size(), 6u);
  const std::vector<WalkerParticle> left = contest.resampled();
  ASSERT_EQ(left.size(), 60u);
  // Equal evidence for the whole stride: as many particles on one foot as on the other.
  int on_left = 0;
  for (const WalkerParticle& p : left) on_left += p.stance == Side::kLeft ? 1 : 0;
  EXPECT_GE(on_left, 15);
  EXPECT_LE(on_left, 45);
}

// Without evidence half of the particles are on the other foot, and the record states it.
TEST(StartHypotheses, StatesTheProbabilityOfMirroredLegs) {
  const Blind blind;
  for (const bool phase_known : {false, true}) {
    StartHypotheses contest = blind.contest(phase_known ? std::optional(0.25) : std::nullopt);
    for (uint32_t frame = 0; !contest.decided(); ++frame)
      ASSERT_TRUE(contest.step(blind.context, {}, frame));
    for (const FrameRecord& record : contest.records())
      EXPECT_NEAR(record.modes.p_legs_swapped, phase_known ? 0 : 0.5, 1e-9);
  }
}

TEST(StartHypotheses, AStatedPhaseIsKept) {
  const Blind blind;
  StartHypotheses contest = blind.contest(0.1);
  uint32_t frame = 0;
  while (!contest.decided()) ASSERT_TRUE(contest.step(blind.context, {}, frame++));
  EXPECT_EQ(contest.frames(), 6);
  for (const WalkerParticle& p : contest.resampled()) EXPECT_EQ(p.stance, Side::kLeft);
}

TEST(StartHypotheses, TheSameForAnyNumberOfThreads) {
  const Blind blind;
  std::vector<double> places[2];
  for (const int threads : {1, 4}) {
    StartHypotheses contest(blind.context.motion, blind.start, blind.filter, blind.detected,
                            blind.ranges(std::nullopt), 5, threads);
    for (uint32_t frame = 0; !contest.decided(); ++frame) contest.step(blind.context, {}, frame);
    for (const WalkerParticle& p : contest.resampled())
      places[threads == 1 ? 0 : 1].push_back(p.pose.root.x());
  }
  EXPECT_EQ(places[0], places[1]);
}

}  // namespace
}  // namespace walktrack
