// The path `sagittal`: straight ahead, for any motion model and noise.
#include <gtest/gtest.h>

#include "fixture.h"
#include "tests/tracker/frame_time.h"
#include "tracker/moves/global_pose.h"
#include "tracker/moves/mirror_legs.h"
#include "tracker/walker_filter.h"

namespace walktrack {
namespace {

class SagittalPath : public testing::TestWithParam<MotionKind> {
 protected:
  std::vector<WalkerParticle> after(int frames) const {
    std::vector<WalkerParticle> set = walkers(context, 1.3, 20);
    for (size_t i = 0; i < set.size(); ++i) {
      Rng rng(3, Purpose::kTest, 0, static_cast<uint32_t>(i));
      draw_first_noise(context, set[i], rng);
      for (int frame = 0; frame < frames; ++frame) {
        propagate(context, set[i], rng);
        perturb(context, 0.5, set[i], rng);
      }
    }
    return set;
  }

  Walking walking{GetParam(), Path::kSagittal};
  MotionContext context = walking.context(kDt);
};

constexpr std::array kSideways{kHeading,        kList,     kAbduction,
                               kAbductionRight, kRotation, kRotationRight};

TEST_P(SagittalPath, NothingTurnsOrGoesSideways) {
  const std::vector<WalkerParticle> start = after(0), set = after(45);
  int moved = 0;
  for (size_t i = 0; i < set.size(); ++i) {
    for (const ResidualAngle k : kSideways) {
      EXPECT_EQ(set[i].residual[k], start[i].residual[k]) << k;
      EXPECT_EQ(set[i].noise[size_t(kResidualNoise) + k], 0) << "is not drawn";
    }
    EXPECT_EQ(set[i].pose.heading, 0);
    EXPECT_EQ(set[i].pose.list, start[i].pose.list);
    moved += set[i].residual[kTilt] != start[i].residual[kTilt];
  }
  EXPECT_EQ(moved, set.size()) << "the upright plane is as free as ever";
}

TEST_P(SagittalPath, WalksOnAsFar) {
  double way = 0;
  const std::vector<WalkerParticle> start = after(0), set = after(30);
  for (size_t i = 0; i < set.size(); ++i)
    way += (set[i].pose.root - start[i].pose.root).x() / double(set.size());
  EXPECT_NEAR(way, 1.3, 0.3);
}

// Legs that do not reach sideways cannot reach across the pelvis to each other's feet.
TEST_P(SagittalPath, MirroredLegsKeepThePelvis) {
  for (const WalkerParticle& particle : after(10)) {
    WalkerParticle mirrored = particle;
    mirror_legs(context, mirrored);
    EXPECT_EQ(mirrored.stance, other(particle.stance));
    EXPECT_LT((mirrored.pose.root - particle.pose.root).norm(), 1e-9);
    EXPECT_EQ(mirrored.residual[kAbduction], particle.residual[kAbductionRight]);
    EXPECT_EQ(mirrored.pose.legs[0].knee_flexion, particle.pose.legs[1].knee_flexion);
    EXPECT_EQ(mirrored.pose_before.legs[0].hip_abduction,
              particle.pose_before.legs[1].hip_abduction);
    EXPECT_EQ(mirrored.pose_before.root, particle.pose_before.root);
    mirror_legs(context, mirrored);
    EXPECT_LT((mirrored.ball - particle.ball).norm(), 1e-9);
    EXPECT_LT((mirrored.pose.root - particle.pose.root).norm(), 1e-9);
  }
}

INSTANTIATE_TEST_SUITE_P(Models, SagittalPath,
                         testing::Values(MotionKind::kKneed, MotionKind::kAnthropomorphic,
                                         MotionKind::kMarkov));

// Without noise the feet land left and right of one line.
TEST(SagittalWalk, GoesAlongALine) {
  const Walking walking(MotionKind::kKneed, Path::kSagittal);
  const MotionContext context = walking.context(kDt);
  WalkerParticle p = walkers(context, 1.2, 1)[0];
  const double line = p.pose.root.y();
  const double x = p.pose.root.x();
  Rng rng(1, Purpose::kTest);
  for (int frame = 0; frame < 150; ++frame) {
    ASSERT_EQ(propagate(context, p, rng), Outcome::kAlive) << frame;
    p.noise.fill(0);
    context.moves.apply_noise(context, p);
    EXPECT_NEAR(p.pose.root.y(), line, 0.02) << frame;
  }
  EXPECT_GT(p.pose.root.x(), x + 4);
}

// A global pose may still be proposed as a whole: place and heading of the line change together.
TEST(SagittalWalk, ASetCanTakeAnotherGlobalPose) {
  const Walking walking(MotionKind::kKneed, Path::kSagittal);
  const MotionContext context = walking.context(kDt);
  WalkerParticle p = walkers_on_their_way(context, 1)[0];
  GlobalPoseSpread spread;
  spread.mean << p.pose.root.head<2>(), 0.1, p.residual[kCrouch], p.residual[kTilt];
  Rng rng(1, Purpose::kTest);
  move_global_pose(context, spread, 1, p, rng);
  EXPECT_NEAR(p.pose.heading, 0.1, 1e-12);
  propagate(context, p, rng);
  EXPECT_NEAR(p.pose.heading, 0.1, 1e-12) << "and keeps it";
}

}  // namespace
}  // namespace walktrack
