#include "tracker/moves/global_pose.h"

#include <cmath>

#include <gtest/gtest.h>

#include "body/kinematics.h"
#include "core/conventions.h"
#include "fixture.h"
#include "tests/tracker/frame_time.h"

namespace walktrack {
namespace {

std::vector<double> equal_weights(size_t count) { return std::vector<double>(count, 0.0); }

TEST(GlobalPoseSpread, OfOneParticleIsItsPlaceAndNoSpread) {
  const Walking walking;
  const MotionContext context = walking.context(kDt);
  const std::vector<WalkerParticle> one = walkers_on_their_way(context, 1);
  const GlobalPoseSpread spread = global_pose_spread(one, equal_weights(1));
  EXPECT_NEAR(spread.mean[0], one[0].pose.root.x(), 1e-12);
  EXPECT_NEAR(spread.mean[2], one[0].pose.heading, 1e-12);
  EXPECT_EQ(spread.factor.norm(), 0);
}

TEST(GlobalPoseSpread, DeadParticlesCountForNothing) {
  const Walking walking;
  const MotionContext context = walking.context(kDt);
  const std::vector<WalkerParticle> set = walkers_on_their_way(context, 2);
  const double dead = -std::numeric_limits<double>::infinity();
  EXPECT_NEAR(global_pose_spread(set, std::vector<double>{0.0, dead}).mean[0], set[0].pose.root.x(),
              1e-12);
  EXPECT_EQ(global_pose_spread(set, std::vector<double>{dead, dead}).factor.norm(), 0);
}

// Law: the spread of headings is the same in every direction, also about -x, where pi becomes -pi.
TEST(GlobalPoseSpread, OfHeadingsIsTheSameInEveryDirection) {
  const Walking walking;
  const MotionContext context = walking.context(kDt);
  for (const double direction : {0.0, kPi, -kPi}) {
    std::vector<WalkerParticle> set = walkers_on_their_way(context, 2);
    set[0].residual[kHeading] = std::remainder(direction + 0.1, 2 * kPi);
    set[1].residual[kHeading] = std::remainder(direction - 0.1, 2 * kPi);
    const GlobalPoseSpread spread = global_pose_spread(set, equal_weights(2));
    EXPECT_NEAR(std::remainder(spread.mean[2] - direction, 2 * kPi), 0, 1e-12) << direction;
    EXPECT_NEAR(spread.factor.row(2).norm(), 0.1, 1e-12) << direction;
    // A move by the whole spread, without noise of its own, stays near.
    Rng rng(1, Purpose::kTest);
    const double before = set[0].predicted_residual[kHeading];
    move_global_pose(context, spread, 0.01, set[0], rng);
    EXPECT_LT(std::abs(set[0].predicted_residual[kHeading] - before), 0.1) << direction;
  }
}

// The factor is the covariance's: an independent sum over two coordinates.
TEST(GlobalPoseSpread, FactorGivesTheCovariance) {
  const Walking walking;
  const MotionContext context = walking.context(kDt);
  const std::vector<WalkerParticle> set = walkers_on_their_way(context, 50);
  const GlobalPoseSpread spread = global_pose_spread(set, equal_weights(set.size()));
  double shared = 0;
  for (const WalkerParticle& p : set)
    shared += (p.pose.root.y() - spread.mean[1]) * (p.pose.heading - spread.mean[2]) / 50;
  const Eigen::Matrix<double, 5, 5> covariance = spread.factor * spread.factor.transpose();
  EXPECT_NEAR(covariance(1, 2), shared, 1e-12);
}

// Many moves do not change the distribution for which they are reversible.
TEST(GlobalPoseMove, KeepsMeanAndSpread) {
  const Walking walking;
  const MotionContext context = walking.context(kDt);
  std::vector<WalkerParticle> set = walkers_on_their_way(context, 400);
  const GlobalPoseSpread before = global_pose_spread(set, equal_weights(set.size()));
  for (size_t i = 0; i < set.size(); ++i) {
    Rng rng(6, Purpose::kMoves, 0, static_cast<uint32_t>(i));
    for (int k = 0; k < 20; ++k) move_global_pose(context, before, 0.5, set[i], rng);
  }
  const GlobalPoseSpread after = global_pose_spread(set, equal_weights(set.size()));
  for (int k = 0; k < 5; ++k) {
    const double sd = before.factor.row(k).norm();
    EXPECT_NEAR(after.mean[k], before.mean[k], 4 * sd / std::sqrt(400.0)) << k;
    // The standard error of a standard deviation is sd / sqrt(2 N).
    EXPECT_NEAR(after.factor.row(k).norm(), sd, 4 * sd / std::sqrt(800.0)) << k;
  }
}

// A rotation about the root moves the whole figure and the frame before: joints keep their
// distances, and movements between the frames have the same length.
TEST(GlobalPoseMove, TurnsTheFigureRigidlyWithItsPast) {
  const Walking walking;
  const MotionContext context = walking.context(kDt);
  WalkerParticle p = walkers_on_their_way(context, 1)[0];
  GlobalPoseSpread spread;
  spread.mean << p.pose.root.x() + 1, p.pose.root.y() - 2, p.pose.heading + 0.4,
      p.residual[kCrouch], p.residual[kTilt];
  const auto joints = [&](const Pose& pose) {
    return forward_kinematics(walking.model.body, pose).joints;
  };
  const JointPositions now = joints(p.pose), before = joints(p.pose_before);
  Rng rng(1, Purpose::kMoves);
  move_global_pose(context, spread, 1, p, rng);  // exactly to the mean: there is no spread
  EXPECT_NEAR(p.pose.root.x(), spread.mean[0], 1e-12);
  EXPECT_NEAR(p.pose.heading, spread.mean[2], 1e-12);
  const JointPositions turned = joints(p.pose), turned_before = joints(p.pose_before);
  for (const Joint j : {Joint::kLeftAnkle, Joint::kRightKnee, Joint::kNeck}) {
    EXPECT_NEAR((turned[j] - turned[Joint::kPelvis]).norm(), (now[j] - now[Joint::kPelvis]).norm(),
                1e-9);
    EXPECT_NEAR((turned[j] - turned_before[j]).norm(), (now[j] - before[j]).norm(), 1e-9);
  }
  // The supporting foot moved as well.
  const Pose again = pose_of(walking.model, p.walker, p.stance, p.aim, p.ball, p.residual);
  EXPECT_LT((again.root - p.pose.root).norm(), 1e-9);
}

}  // namespace
}  // namespace walktrack
