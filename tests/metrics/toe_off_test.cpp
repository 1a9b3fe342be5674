#include "metrics/steps/toe_off.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "metrics/gait.h"
#include "tests/body/changed_motion.h"
#include "tests/metrics/test_walk.h"

namespace walktrack {
namespace {

// A weighted mean over about 0.2 s: what a tracker's smoothing does to a foot that starts suddenly.
Motion smoothed(const Motion& motion) {
  return changed(motion, [&](JointPositions& joints, size_t i) {
    constexpr std::ptrdiff_t kReach = 3;
    const auto row = static_cast<std::ptrdiff_t>(i), rows = std::ssize(motion.joints);
    if (row < kReach || row + kReach >= rows) return;
    for (size_t j = 0; j < kJointCount; ++j) {
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      double weights = 0;
      for (std::ptrdiff_t k = -kReach; k <= kReach; ++k) {
        const double weight = static_cast<double>(kReach + 1 - std::abs(k));
        sum += weight * motion.joints[static_cast<size_t>(row + k)].at[j];
        weights += weight;
      }
      joints.at[j] = sum / weights;
    }
  });
}

// Mean lateness of the toe-offs of a walk, s.
double lateness(const Motion& motion, const TestWalk& walk) {
  double sum = 0;
  int count = 0;
  for (const GaitEvent& event : gait_from_motion(motion).events) {
    if (event.kind != GaitEventKind::kToeOff) continue;
    const double leaves =
        2 * walk.step_time * walk.stance_share + (event.side == Side::kLeft ? 0 : walk.step_time);
    sum += std::remainder(event.time - leaves, 2 * walk.step_time);
    ++count;
  }
  EXPECT_GE(count, 5) << walk.rate;
  return sum / count;
}

// Law: an even smoothing of the motion does not move its toe-offs. (The moments in which the toe is
// furthest behind the pelvis come 20 ms earlier with this one.)
TEST(ToeOff, ComesAtTheSameTimeInASmoothedMotion) {
  for (const double rate : {30.0, 60.0}) {
    for (const double speed : {0.6, 1.2, 1.8}) {
      const TestWalk walk{.speed = speed, .step_time = 0.55, .rate = rate};
      const Motion motion = walk_motion(walk);
      EXPECT_NEAR(lateness(smoothed(motion), walk), lateness(motion, walk), 0.006)
          << rate << ' ' << speed;
    }
  }
}

TEST(ToeOff, IsTheSameAtAnyFrameRate) {
  const double expected = lateness(walk_motion({.rate = 240}), {});
  for (const double rate : {15.0, 30.0, 60.0, 120.0})
    EXPECT_NEAR(lateness(walk_motion({.rate = rate}), {.rate = rate}), expected, 0.008) << rate;
}

TEST(ToeOff, HalfTheHighestSpeedLessTheRise) {
  const std::vector<double> time{0, 0.1, 0.2, 0.3, 0.4}, speed{0, 1, 3, 4, 3};
  // Half of the highest speed at 0.15 s; the pelvis has a quarter of it.
  const auto found = toe_off_time(time, speed, 1, 1);
  ASSERT_TRUE(found);
  EXPECT_NEAR(*found, 0.15 - kRiseTime * (kHalfSpeed - 0.25), 1e-12);
  EXPECT_EQ(*toe_off_time(time, speed, 1, 9), *toe_off_time(time, speed, 1, 4));
}

TEST(ToeOff, NoneWithoutASwing) {
  const std::vector<double> time{0, 0.1, 0.2, 0.3};
  EXPECT_FALSE(toe_off_time(time, std::vector<double>{0, 1, 2, 3}, 1, 1)) << "it is still rising";
  EXPECT_FALSE(toe_off_time(time, std::vector<double>{0, -1, -2, -3}, 1, 1));
  EXPECT_FALSE(toe_off_time(time, std::vector<double>{3, 4, 3, 0}, 0, 1)) << "it had begun before";
}

// Whose last swing the video cuts has a toe-off nevertheless.
TEST(ToeOff, TheTurningPointIsTakenWhereTheMotionEnds) {
  const TestWalk walk{.duration = 2.2};
  const Motion whole = walk_motion(walk);
  const double last = gait_from_motion(whole).events.back().time;
  for (size_t rows = whole.time.size() - 20; rows < whole.time.size(); ++rows) {
    Motion cut = whole;
    cut.time.resize(rows);
    cut.joints.resize(rows);
    for (const GaitEvent& event : gait_from_motion(cut).events) {
      EXPECT_TRUE(std::isfinite(event.time));
      EXPECT_LE(event.time, std::max(last, cut.time.back()));
    }
  }
}

}  // namespace
}  // namespace walktrack
