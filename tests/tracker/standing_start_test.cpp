#include "tracker/detect/standing_start.h"

#include <gtest/gtest.h>

#include "fixture.h"
#include "tests/tracker/frame_time.h"

namespace walktrack {
namespace {

using Eigen::Vector2d;

const DetectedWalk kWalk{.position = {2, 1}, .velocity = {1.2, 0}};

// A person stood at a place until the frame before the walk, and was visible in so many frames,
// except for some.
struct Stood {
  Vector2d at{2.1, 1};
  size_t frames = 20, without = 0;
  std::optional<double> operator()(size_t back, const Vector2d& place, double) const {
    if (back > frames) return std::nullopt;
    if (back == without) return -5;
    return 50 - 100 * (place - at).norm();
  }
};

TEST(StandingStart, IsFoundWhereAndForHowLongSomebodyStood) {
  const auto found = standing_before(kWalk, Stood{}, kDt, {});
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->detected.standing);
  EXPECT_NEAR((found->detected.position - Vector2d(2.1, 1)).norm(), 0, 0.026);
  EXPECT_EQ(found->detected.velocity, kWalk.velocity);
  EXPECT_EQ(found->frames, 20u);
}

TEST(StandingStart, OutlivesABadFrameButNoGap) {
  EXPECT_EQ(standing_before(kWalk, Stood{.without = 12}, kDt, {})->frames, 20u);
  const auto gone = [](size_t back, const Vector2d& place, double heading) {
    return back > 8 && back < 16 ? std::optional(-5.0) : Stood{}(back, place, heading);
  };
  EXPECT_EQ(standing_before(kWalk, gone, kDt, {})->frames, 8u);
}

// Keypoints are evidence in some of the frames only.
TEST(StandingStart, BeginsWithTheVideoIfTheFirstFramesShowALittleOfThem) {
  const auto found = [](double first_frames) {
    const auto score = [&](size_t back, const Vector2d& place, double heading) {
      return back > 18 && back <= 20 ? std::optional(first_frames) : Stood{}(back, place, heading);
    };
    return standing_before(kWalk, score, kDt, {})->frames;
  };
  EXPECT_EQ(found(DetectorConfig{}.least_score + 1), 20u);
  EXPECT_EQ(found(DetectorConfig{}.least_score - 1), 18u);
}

TEST(StandingStart, NobodyStoodWhereTheVideoBeginsOrNothingIsSeen) {
  EXPECT_FALSE(standing_before(kWalk, Stood{.frames = 0}, kDt, {}));
  EXPECT_FALSE(standing_before(kWalk, Stood{.at = {9, 9}}, kDt, {}));
}

TEST(StandingStart, TheFigureStandsUprightOnTheGround) {
  const BodyModel model = test_model();
  const Pose pose = standing_pose(model);
  const auto joints = forward_kinematics(model.body, pose).joints;
  EXPECT_NEAR(pose.root.z(), leg_length(model.body.lengths), 0.02);
  EXPECT_NEAR(joints[Joint::kLeftAnkle].x(), joints[Joint::kRightAnkle].x(), 0.01);
  EXPECT_NEAR(joints[Joint::kLeftAnkle].z(), joints[Joint::kRightAnkle].z(), 0.01);
  EXPECT_GT(joints[Joint::kLeftAnkle].y(), joints[Joint::kRightAnkle].y());
}

}  // namespace
}  // namespace walktrack
