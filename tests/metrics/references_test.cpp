#include "metrics/references.h"

#include <gtest/gtest.h>

#include "tests/metrics/test_walk.h"

namespace walktrack {
namespace {

// The stances of which the walk was made: strike k (left for even k) at k step times.
std::vector<FootPlant> plants_of(const TestWalk& walk) {
  std::vector<FootPlant> plants;
  const double stride_time = 2 * walk.step_time, stride = walk.speed * stride_time;
  for (int k = 1; k < 6; ++k) {
    const double on = k * walk.step_time;
    plants.push_back({k % 2 == 0 ? Side::kLeft : Side::kRight, on,
                      on + walk.stance_share * stride_time,
                      (0.5 * k + walk.stance_share / 2) * stride});
  }
  return plants;
}

constexpr double kTrim = 4 / 30.0;

TEST(FootPlantErrors, AreZeroForTheWalkThatMadeThem) {
  const TestWalk walk;
  const FootPlantErrors e = foot_plant_errors(plants_of(walk), walk_motion(walk), kTrim);
  EXPECT_EQ(e.found, 5u);
  EXPECT_LT(e.mean_error, 1e-9);
}

TEST(FootPlantErrors, MeasureAnOffsetAlongTheWalkOnly) {
  const TestWalk walk;
  const Motion shifted = changed(walk_motion(walk), [](JointPositions& joints, size_t) {
    for (Eigen::Vector3d& p : joints.at) p += Eigen::Vector3d(0.06, 0.4, 0);
  });
  const FootPlantErrors e = foot_plant_errors(plants_of(walk), shifted, kTrim);
  EXPECT_EQ(e.found, 5u);
  EXPECT_NEAR(e.mean_error, 0.06, 1e-9);
}

TEST(FootPlantErrors, SwappedSidesAreNotFound) {
  const TestWalk walk;
  const Motion bad =
      changed(walk_motion(walk), [](JointPositions& joints, size_t) { mirror_legs(joints); });
  EXPECT_EQ(foot_plant_errors(plants_of(walk), bad, kTrim).found, 0u);
}

TEST(FootPlantErrors, TheOtherFootNeedNotBeKnown) {
  const TestWalk walk;
  const Motion left = changed(walk_motion(walk), [](JointPositions& joints, size_t) {
    joints[ankle(Side::kRight)] = joints[toe(Side::kRight)] = unknown_joints()[Joint::kPelvis];
  });
  std::vector<FootPlant> plants = plants_of(walk);
  std::erase_if(plants, [](const FootPlant& plant) { return plant.side == Side::kRight; });
  EXPECT_EQ(foot_plant_errors(plants, left, kTrim).found, plants.size());
}

TEST(FootPlantErrors, AShortStanceCountsForPresenceOnly) {
  const TestWalk walk;
  std::vector<FootPlant> plants = plants_of(walk);
  plants.resize(1);
  plants[0].off = plants[0].on + 0.2;  // shorter than twice the trim
  const FootPlantErrors e = foot_plant_errors(plants, walk_motion(walk), kTrim);
  EXPECT_EQ(e.found, 1u);
  EXPECT_TRUE(std::isnan(e.plants[0].error));
  EXPECT_TRUE(std::isnan(e.mean_error));
}

TEST(GroundErrors, MeasureThePelvisFromItsFirstKnownFrame) {
  const TestWalk walk;
  GroundPoints truth;
  for (int i = 0; i < 20; ++i) {
    truth.time.push_back(i / 7.0);
    truth.points.push_back({walk.speed * i / 7.0 + 0.3, 0.4});
  }
  const Motion late = changed(walk_motion(walk), [](JointPositions& joints, size_t i) {
    if (i < 32) joints = unknown_joints();
  });
  const GroundErrors e = ground_errors(truth, late);
  EXPECT_EQ(e.frames, 12u);  // i >= 8: t = 1.14 s is the first at or after frame 32
  EXPECT_EQ(e.filled_share, 1);
  EXPECT_NEAR(e.distance.median, 0.5, 1e-9);
}

}  // namespace
}  // namespace walktrack
