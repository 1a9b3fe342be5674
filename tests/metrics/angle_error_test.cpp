#include "metrics/angle_error.h"

#include <gtest/gtest.h>

#include "body/kinematics.h"
#include "core/conventions.h"

namespace walktrack {
namespace {

Motion posed(double knee_more, double heading_more) {
  const Body body = make_body(Subject{}, {});
  Motion motion;
  for (int i = 0; i < 20; ++i) {
    Pose pose;
    pose.heading = kPi - 0.05 + heading_more;  // turns across the seam at pi
    pose.legs[1].knee_flexion = 0.3 + 0.02 * i + knee_more;
    pose.legs[0].hip_flexion = 0.02 * i;
    motion.time.push_back(i / 30.0);
    motion.joints.push_back(forward_kinematics(body, pose).joints);
  }
  return motion;
}

TEST(AngleErrors, FindTheAngleThatIsWrongAndOnlyThat) {
  const auto errors = angle_errors(posed(0, 0), posed(-0.1, 0.1));
  for (size_t i = 0; i < kAngleCount; ++i) {
    const double expected = kAngleNames[i] == "rknee_flexion" ? -0.1
                            : kAngleNames[i] == "heading"     ? 0.1
                                                              : 0.0;
    EXPECT_EQ(errors[i].count, 20u);
    EXPECT_NEAR(errors[i].bias, expected, 1e-9) << kAngleNames[i];
    EXPECT_NEAR(errors[i].rms, std::abs(expected), 1e-9) << kAngleNames[i];
    EXPECT_NEAR(errors[i].mean_absolute, std::abs(expected), 1e-9) << kAngleNames[i];
  }
}

TEST(AngleErrors, UnknownFramesDoNotCount) {
  Motion lost = posed(0, 0);
  lost.joints[3] = unknown_joints();
  EXPECT_EQ(angle_errors(posed(0, 0), lost)[0].count, 19u);
}

}  // namespace
}  // namespace walktrack
