// The table of a particle's residual angles.
#include "tracker/state/residual_table.h"

#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "fixture.h"
#include "tracker/state/noise_groups.h"

namespace walktrack {
namespace {

TEST(ResidualTable, HasOneRowForEachAngle) {
  std::multiset<int> angles;
  for (const ResidualRow& row : kResidualTable) {
    angles.insert(row.left);
    if (row.paired()) angles.insert(row.right);
  }
  for (const ResidualAngle angle : kAllResiduals) {
    EXPECT_EQ(angles.count(angle), 1u) << angle;
    EXPECT_TRUE(row_of(angle).left == angle || row_of(angle).right == angle) << angle;
  }
  EXPECT_EQ(angles.size(), size_t{kResidualCount});
}

TEST(ResidualTable, HasProcessesThatRestWithinTheirLimits) {
  for (const ResidualRow& row : kResidualTable) {
    const MarkovConstants& process = row.process;
    EXPECT_LT(process.lowest, process.rest) << row.left;
    EXPECT_GT(process.highest, process.rest) << row.left;
    // The noise of the heading is MotionConfig::yaw_rate_sd.
    EXPECT_EQ(process.spread > 0, row.left != kHeading) << row.left;
    EXPECT_GT(process.time, 0) << row.left;
    EXPECT_GE(row.standing_time, process.time) << row.left;
  }
}

// Whether a pose made of these leaves the upright plane with heading 0.
bool leaves_plane(const BodyModel& model, const ResidualAngles& residual) {
  const Pose pose = pose_of(model, {}, Side::kLeft, {1.2, 0.6}, {0, 0}, residual);
  const JointPositions joints = forward_kinematics(model.body, pose).joints,
                       still = forward_kinematics(model.body, pose_of(model, {}, Side::kLeft,
                                                                      {1.2, 0.6}, {0, 0}, {}))
                                   .joints;
  // The supporting foot does not move, but the root does: positions relative to it.
  const Eigen::Vector3d by = joints[Joint::kPelvis] - still[Joint::kPelvis];
  for (size_t j = 0; j < kJointCount; ++j)
    if (std::abs((joints.at[j] - still.at[j] - by).y()) > 1e-6) return true;
  return false;
}

TEST(ResidualTable, SaysWhatMovesSideways) {
  BodyModel model = test_model();
  model.body = make_body(Subject{}, {.head = true, .arms = true});
  for (const ResidualAngle angle : kAllResiduals) {
    ResidualAngles residual{};
    residual[angle] = 0.1;
    // A leg's rotation moves only the foot, and not the supporting foot.
    if (angle == kRotation) continue;
    EXPECT_EQ(leaves_plane(model, residual), row_of(angle).sideways) << angle;
  }
}

TEST(ResidualTable, GroupsOfNoiseHoldWhatIsFreeEachOnce) {
  for (const Path path : {Path::kSpatial, Path::kSagittal}) {
    BodyModel model = test_model(path);
    model.body = make_body(Subject{}, {.head = true, .arms = true});
    const Walking walking(MotionKind::kKneed, path);
    std::multiset<int> grouped;
    for (const NoiseGroup group : walking.moves->noise_groups(path))
      grouped.insert(group.begin(), group.end());
    std::multiset<int> wanted;
    for (int k = 0; k < kResidualNoise; ++k) wanted.insert(k);
    for (const ResidualAngle angle : free_residuals(model)) wanted.insert(noise_of(angle));
    EXPECT_EQ(grouped, wanted);
  }
}

}  // namespace
}  // namespace walktrack
