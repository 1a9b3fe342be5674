#include "jobs/track/track_quality.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/run_program.h"

namespace walktrack {
namespace {

constexpr double kLeg = 0.9;  // m

FrameRecord still() {
  FrameRecord record;
  record.tracked = true;
  record.estimate.joint_count = kJointCountWithoutArms;
  for (Eigen::Vector3d& joint : record.estimate.joints.at) joint.setZero();
  return record;
}

class QualityOf : public testing::Test {
 protected:
  // Somebody who does what `record` says in every frame, tracked but in the frames named.
  TrackedFrames standing(int count, std::initializer_list<int> lost,
                         const FrameRecord& record = still()) const {
    TrackedFrames frames{30, FrameFile(folder_ / ("frames" + std::to_string(files_++)))};
    for (int i = 0; i < count; ++i) {
      FrameRecord each = record;
      each.tracked = std::ranges::find(lost, i) == lost.end();
      frames.records.append(each);
    }
    return frames;
  }
  TemporaryFolder folder_;
  mutable int files_ = 0;
};

// Of a track whose feet were left where they were.
Quality quality_of(const TrackedFrames& frames, const GateConfig& gates = {}) {
  return walktrack::quality_of(frames, frames, gates, kLeg);
}

const QualityMeasure& named(const Quality& quality, const std::string& name) {
  for (const QualityMeasure& m : quality)
    if (m.name == name) return m;
  throw std::out_of_range(name);
}

TEST_F(QualityOf, CountsLostFramesFromTheFirstTrackedOneOn) {
  const Quality quality = quality_of(standing(12, {0, 1, 5, 6}));
  EXPECT_DOUBLE_EQ(named(quality, "lost_percent").value, 20);
  EXPECT_FALSE(named(quality, "lost_percent").passed());
}

TEST_F(QualityOf, NobodyTrackedLosesNothing) {
  EXPECT_EQ(named(quality_of(standing(2, {0, 1})), "lost_percent").value, 0);
  EXPECT_EQ(named(quality_of(standing(0, {})), "leg_swaps_per_min").value, 0);
}

TEST_F(QualityOf, FeetBelowTheGroundFailTheirGate) {
  FrameRecord sunken = still();
  sunken.estimate.joints[Joint::kLeftToe].z() = -0.02;
  const TrackedFrames frames = standing(12, {}, sunken);
  GateConfig gates;
  gates.least_steps = 0;
  gates.penetration = 0.015;
  const Quality quality = quality_of(frames, gates);
  EXPECT_DOUBLE_EQ(named(quality, "penetration_mm").value, 20);
  EXPECT_THAT(first_failure(quality), testing::HasSubstr("planted: 20 mm (allowed: at most 15)"));
  gates.penetration = 0.025;
  EXPECT_EQ(first_failure(quality_of(frames, gates)), "");
}

// Feet that were planted tell little of a track that fails.
TEST_F(QualityOf, GatesOnFeetAreForWhatWasTracked) {
  FrameRecord sunken = still();
  sunken.estimate.joints[Joint::kLeftToe].z() = -0.02;
  const TrackedFrames moving = standing(12, {}, sunken), planted = standing(12, {}, still());
  GateConfig gates;
  gates.least_steps = 0;
  gates.penetration = 0.015;
  const Quality quality = walktrack::quality_of(planted, moving, gates, kLeg);
  EXPECT_EQ(named(quality, "penetration_mm").value, 0);
  EXPECT_TRUE(named(quality, "penetration_mm").passed());
  EXPECT_FALSE(named(quality, "tracked_penetration_mm").passed());
  EXPECT_EQ(*named(quality, "tracked_foot_slide_mm").gate, 150);
}

TEST_F(QualityOf, WhoStandsDoesNotWalk) {
  const Quality quality = quality_of(standing(12, {}));
  EXPECT_THAT(first_failure(quality), testing::HasSubstr("(allowed: at least 1)"));
}

}  // namespace
}  // namespace walktrack
