#include "jobs/track/report/viewing_ray.h"

#include <limits>

#include <gtest/gtest.h>

#include "tests/observation/scenes.h"

namespace walktrack {
namespace {

// The pelvis of somebody who walks for three seconds in a direction, swaying, 30 rows a second.
Motion walk_towards(const Eigen::Vector2d& velocity) {
  Motion out;
  for (int i = 0; i < 90; ++i) {
    const double time = i / 30.0;
    JointPositions joints;
    const Eigen::Vector2d place = time * velocity + Eigen::Vector2d(0, 0.03 * std::sin(6 * time));
    joints[Joint::kPelvis] = {place.x(), place.y(), 0.9};
    out.time.push_back(time);
    out.joints.push_back(joints);
  }
  return out;
}

const Eigen::Vector2d kCamera{8, 0};

TEST(ViewingRay, ShareOfTheWay) {
  EXPECT_GT(share_along_rays(walk_towards({1.2, 0}), kCamera), 0.98);
  EXPECT_GT(share_along_rays(walk_towards({-1.2, 0}), kCamera), 0.98) << "away from it";
  EXPECT_LT(share_along_rays(walk_towards({0, 1.2}), kCamera), 0.3);
  EXPECT_EQ(share_along_rays(Motion{}, kCamera), 0);
}

TEST(ViewingRay, RowsWithoutAPelvisAreLeftOut) {
  Motion motion = walk_towards({1.2, 0});
  for (size_t i = 20; i < 40; ++i)
    motion.joints[i][Joint::kPelvis].setConstant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_GT(share_along_rays(motion, kCamera), 0.98);
  for (JointPositions& joints : motion.joints)
    joints[Joint::kPelvis].setConstant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(share_along_rays(motion, kCamera), 0);
}

TEST(ViewingRay, IsNotedWhereTheWalkIsRatherAlongIt) {
  const Camera camera = camera_at({8, 0, 1.2}, {0, 0, 0.9}, 600, 640, 480);
  EXPECT_TRUE(viewing_ray_note(walk_towards({1.2, 0.3}), camera));
  EXPECT_FALSE(viewing_ray_note(walk_towards({0.3, 1.2}), camera));
}

}  // namespace
}  // namespace walktrack
