#include "jobs/track/out_of_picture.h"

#include <vector>

#include <gtest/gtest.h>

#include "tests/camera/made_camera.h"

namespace walktrack {
namespace {

// A figure whose joints are in one place, except for a foot that trails behind.
FrameEstimate figure_at(double x) {
  FrameEstimate out;
  out.joint_count = kJointCountWithoutArms;
  for (Eigen::Vector3d& joint : out.joints.at) joint = {x, 0, 0.9};
  out.joints[Joint::kLeftToe] = {x - 0.5, 0, 0};
  return out;
}

// The camera sees 2 m on either side of x = 0.
TEST(OutOfPicture, FromTheLastJointOutToTheHipsBackIn) {
  const std::vector<Camera> cameras{
      looking_at(lens({400, 300}, {400, 400}, {199.5, 149.5}), {0, -4, 0.9}, {0, 0, 0.9})};
  EXPECT_FALSE(out_of_picture(cameras, figure_at(1.9), false));
  EXPECT_FALSE(out_of_picture(cameras, figure_at(2.2), false)) << "a foot is in it";
  EXPECT_TRUE(out_of_picture(cameras, figure_at(2.6), false));
  EXPECT_TRUE(out_of_picture(cameras, figure_at(2.2), true)) << "does not flicker at the edge";
  EXPECT_FALSE(out_of_picture(cameras, figure_at(1.9), true));
}

}  // namespace
}  // namespace walktrack
