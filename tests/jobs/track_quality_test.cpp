#include "jobs/track_quality.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace walktrack {
namespace {

// Somebody who stands still, tracked but in the frames named.
TrackedFrames standing(int count, std::initializer_list<size_t> lost) {
  TrackedFrames frames;
  frames.records.resize(static_cast<size_t>(count));
  for (FrameRecord& record : frames.records) {
    record.tracked = true;
    record.estimate.joint_count = kJointCountWithoutArms;
  }
  for (const size_t i : lost) frames.records[i].tracked = false;
  return frames;
}

const QualityMeasure& named(const Quality& quality, const std::string& name) {
  for (const QualityMeasure& m : quality)
    if (m.name == name) return m;
  throw std::out_of_range(name);
}

TEST(QualityOf, CountsLostFramesFromTheFirstTrackedOneOn) {
  const Quality quality = quality_of(standing(12, {0, 1, 5, 6}), GateConfig{});
  EXPECT_DOUBLE_EQ(named(quality, "lost_percent").value, 20);
  EXPECT_FALSE(named(quality, "lost_percent").passed());
}

TEST(QualityOf, NobodyTrackedLosesNothing) {
  EXPECT_EQ(named(quality_of(standing(2, {0, 1}), GateConfig{}), "lost_percent").value, 0);
  EXPECT_EQ(named(quality_of(TrackedFrames{}, GateConfig{}), "leg_swaps_per_min").value, 0);
}

TEST(QualityOf, FeetBelowTheGroundFailTheirGate) {
  TrackedFrames frames = standing(12, {});
  for (FrameRecord& record : frames.records) record.estimate.joints[Joint::kLeftToe].z() = -0.02;
  GateConfig gates;
  gates.least_steps = 0;
  gates.penetration = 0.015;
  const Quality quality = quality_of(frames, gates);
  EXPECT_DOUBLE_EQ(named(quality, "penetration_mm").value, 20);
  EXPECT_THAT(first_failure(quality), testing::HasSubstr("in the ground: 20 mm (gate at most 15)"));
  gates.penetration = 0.025;
  EXPECT_EQ(first_failure(quality_of(frames, gates)), "");
}

TEST(QualityOf, WhoStandsDoesNotWalk) {
  const Quality quality = quality_of(standing(12, {}), GateConfig{});
  EXPECT_THAT(first_failure(quality), testing::HasSubstr("(gate at least 1)"));
}

}  // namespace
}  // namespace walktrack
