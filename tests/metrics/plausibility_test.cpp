#include "metrics/plausibility.h"

#include <gtest/gtest.h>

#include "tests/metrics/test_walk.h"

namespace walktrack {
namespace {

Plausibility of(const Motion& motion) { return plausibility(motion, gait_from_motion(motion)); }

TEST(Plausibility, StandingFeetDoNotSlide) {
  const Plausibility p = of(walk_motion({}));
  EXPECT_GE(p.stances, 5u);
  EXPECT_LT(p.worst_foot_slide, 1e-9);
  EXPECT_EQ(p.penetration, 0);
}

TEST(Plausibility, FindsFeetThatDriftWithThePelvis) {
  // A world that slides by 10 mm per second: the flat part lasts 45 % of 0.6 strides of 1.1 s.
  const TestWalk walk;
  const Motion drifting = changed(walk_motion(walk), [&](JointPositions& joints, size_t i) {
    for (Eigen::Vector3d& p : joints.at) p.y() += 0.1 * double(i) / walk.rate;
  });
  const double expected = 0.1 * 0.45 * walk.stance_share * 2 * walk.step_time;
  // Rows are 33 ms apart, so that up to one row of travel at either end is missed.
  EXPECT_NEAR(of(drifting).mean_foot_slide, expected, 2 * 0.1 / walk.rate);
}

// A heading that is wrong by some degrees moves feet across the walk, a wrong step along it.
TEST(Plausibility, TellsFeetThatDriftAlongTheWalkFromThoseThatDriftAcross) {
  const TestWalk walk;
  const auto drifting = [&](const Eigen::Vector3d& velocity) {
    return of(changed(walk_motion(walk), [&](JointPositions& joints, size_t i) {
      for (Eigen::Vector3d& p : joints.at) p += double(i) / walk.rate * velocity;
    }));
  };
  const Plausibility across = drifting({0, 0.1, 0}), along = drifting({0.1, 0, 0});
  const double turned = std::atan2(0.1, walk.speed);  // the direction in which the pelvis drifts
  EXPECT_NEAR(across.mean_slide_along, across.mean_foot_slide * std::sin(turned), 1e-3);
  EXPECT_NEAR(along.mean_slide_along, along.mean_foot_slide, 1e-9);
  EXPECT_GT(along.mean_slide_along, 0.02);
}

TEST(Plausibility, ASlideWithoutADirectionCountsAsAWhole) {
  const TestWalk walk;
  const Motion drifting = changed(walk_motion(walk), [&](JointPositions& joints, size_t i) {
    for (Eigen::Vector3d& p : joints.at) p.y() += 0.1 * double(i) / walk.rate;
  });
  Gait without_strides = gait_from_motion(drifting);
  without_strides.stride_time = 0;
  const Plausibility p = plausibility(drifting, without_strides);
  EXPECT_GT(p.mean_foot_slide, 0.02);
  EXPECT_EQ(p.mean_slide_along, p.mean_foot_slide);
}

TEST(Plausibility, FindsFeetInTheGround) {
  const Motion low = changed(walk_motion({}), [](JointPositions& joints, size_t i) {
    if (i % 2 == 0) joints[Joint::kLeftToe].z() = -0.03;
  });
  EXPECT_NEAR(of(low).penetration, 0.03, 1e-12);
  EXPECT_NEAR(of(low).penetrating_share, 0.5, 1e-12);
}

TEST(Plausibility, JitterIsTheThirdDerivative) {
  Motion cubic = walk_motion({});
  cubic = changed(cubic, [&](JointPositions& joints, size_t i) {
    const double t = cubic.time[i];
    joints.at.fill(Eigen::Vector3d(2 * t * t * t, 3 * t * t, 1));
  });
  EXPECT_NEAR(of(cubic).jitter, 12, 1e-6);  // 1e-15 of 1 m over (1/30 s)^3, sixteen times
}

TEST(Plausibility, StepsGoAsFarAsTheBody) {
  const TestWalk walk;
  const Plausibility p = of(walk_motion(walk));
  EXPECT_NEAR(p.longest_step, walk.speed * walk.step_time, 1e-3);
  EXPECT_NEAR(p.shortest_step, walk.speed * walk.step_time, 1e-3);
  EXPECT_LT(p.steps_off_way, 0.01);
  EXPECT_NEAR(p.fastest, walk.speed, 1e-6);
  EXPECT_LT(p.missing_steps, 0.1);
}

TEST(Plausibility, FindsABodyThatMovesOnWithoutSteps) {
  const TestWalk walk;
  const Motion right = walk_motion(walk);
  const Motion gliding = changed(right, [&](JointPositions& joints, size_t) {
    for (const Joint joint :
         {Joint::kLeftAnkle, Joint::kLeftToe, Joint::kRightAnkle, Joint::kRightToe})
      joints[joint].x() = joints[Joint::kPelvis].x();
  });
  EXPECT_NEAR(of(gliding).missing_steps, walk.speed * walk.duration / 1.1 - 2, 0.1);
  // Of two walks four steps are incomplete.
  const Motion gap = changed(right, [&](JointPositions& joints, size_t i) {
    if (i / 20 == right.time.size() / 40) joints = unknown_joints();
  });
  EXPECT_EQ(gait_from_motion(gap).walks, 2U);
  EXPECT_LT(of(gap).missing_steps, 0.1);
}

// From the middle of a walk on, the legs are swapped.
TEST(Plausibility, FindsLegsThatChangePlaces) {
  const TestWalk walk;
  const Motion right = walk_motion(walk);
  EXPECT_NEAR(of(right).quickest_step, 1, 0.05);
  const auto swapped_from = [&](double time) {
    return changed(right, [&](JointPositions& joints, size_t i) {
      if (right.time[i] < time) return;
      std::swap(joints[Joint::kLeftHip], joints[Joint::kRightHip]);
      std::swap(joints[Joint::kLeftKnee], joints[Joint::kRightKnee]);
      std::swap(joints[Joint::kLeftAnkle], joints[Joint::kRightAnkle]);
      std::swap(joints[Joint::kLeftToe], joints[Joint::kRightToe]);
    });
  };
  for (const double share : {0.2, 0.4, 0.6, 0.8}) {
    const double middle = right.time[right.time.size() / 2];
    EXPECT_LT(of(swapped_from(middle + share * walk.step_time)).quickest_step, 0.6) << share;
  }
  EXPECT_EQ(of({}).quickest_step, 1);
}

TEST(Plausibility, FindsABodyThatLeavesItsFeetBehind) {
  const TestWalk walk;
  const Motion hasty = changed(walk_motion(walk), [&](JointPositions& joints, size_t i) {
    joints[Joint::kPelvis].x() += 0.2 * double(i) / walk.rate;
  });
  EXPECT_NEAR(of(hasty).steps_off_way, 1 - walk.speed / (walk.speed + 0.2), 0.02);
}

TEST(Plausibility, FindsTheFastestHalfSecondBetweenGaps) {
  const Motion leaping = changed(walk_motion({}), [](JointPositions& joints, size_t i) {
    for (Eigen::Vector3d& p : joints.at) p.x() += i < 60 ? 0 : 2;  // 2 m from one row to the next
  });
  EXPECT_NEAR(of(leaping).fastest, 1.2 + 2 / 0.5, 0.1);
  const Motion apart = changed(leaping, [](JointPositions& joints, size_t i) {
    if (i == 60) joints = unknown_joints();
  });
  EXPECT_NEAR(of(apart).fastest, 1.2, 1e-6) << "nobody knows what happened in a gap";
  EXPECT_EQ(of({}).fastest, 0);
}

}  // namespace
}  // namespace walktrack
