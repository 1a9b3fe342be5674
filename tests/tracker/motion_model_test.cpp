// Laws that every motion model keeps.
#include "tracker/motion/motion_model.h"

#include <cmath>

#include <gtest/gtest.h>

#include "fixture.h"
#include "tests/tracker/frame_time.h"
#include "tracker/moves/global_pose.h"

namespace walktrack {
namespace {

class EveryMotionModel : public testing::TestWithParam<MotionKind> {
 protected:
  Walking walking_{GetParam()};
};

bool same(const Pose& a, const Pose& b) {
  return a.root == b.root && a.heading == b.heading && a.tilt == b.tilt &&
         a.legs[0].hip_flexion == b.legs[0].hip_flexion &&
         a.legs[1].knee_flexion == b.legs[1].knee_flexion;
}

// The result for a particle depends on its own numbers alone, not on the others in the group.
TEST_P(EveryMotionModel, ParticlesDoNotDependOnTheirGroup) {
  const MotionContext context = walking_.context(kDt);
  const std::vector<WalkerParticle> start = walkers_on_their_way(context, 9);
  const auto stream = [](size_t i) { return Rng(3, Purpose::kTest, 0, static_cast<uint32_t>(i)); };
  std::vector<WalkerParticle> group = start;
  std::vector<Rng> rngs;
  for (size_t i = 0; i < group.size(); ++i) rngs.push_back(stream(i));
  std::vector<Outcome> outcomes(group.size());
  propagate(context, group, rngs, outcomes);
  for (size_t i = 0; i < group.size(); ++i) {
    WalkerParticle alone = start[i];
    Rng rng = stream(i);
    EXPECT_EQ(propagate(context, alone, rng), outcomes[i]);
    EXPECT_TRUE(same(alone.pose, group[i].pose)) << "particle " << i;
  }
}

TEST_P(EveryMotionModel, PerturbLeavesTheStandardNormalPriorOfTheNoiseInvariant) {
  const MotionContext context = walking_.context(kDt);
  constexpr int kChains = 4000;
  double sum = 0, squares = 0;
  WalkerParticle p = walkers(context, 1.2, 1)[0];
  for (uint32_t i = 0; i < kChains; ++i) {
    Rng rng(i, Purpose::kTest);
    for (double& z : p.noise) z = rng.normal();
    for (int move = 0; move < 5; ++move) perturb(context, 0.5, p, rng);
    const double z = p.noise[int{kResidualNoise} + kTilt];
    sum += z;
    squares += z * z;
  }
  EXPECT_NEAR(sum / kChains, 0, 5 / std::sqrt(double{kChains}));
  EXPECT_NEAR(squares / kChains, 1, 5 * std::sqrt(2.0 / kChains));
}

// Applying noise twice is the same as once: moves may return to earlier values.
TEST_P(EveryMotionModel, ThePoseFollowsFromPredictionAndNoise) {
  const MotionContext context = walking_.context(kDt);
  for (WalkerParticle p : walkers_on_their_way(context, 20)) {
    const Pose pose = p.pose;
    const auto noise = p.noise;
    Rng rng(4, Purpose::kTest);
    perturb(context, 0.9, p, rng);
    p.noise = noise;
    context.moves.apply_noise(context, p);
    EXPECT_TRUE(same(p.pose, pose));
  }
}

// A change of the global pose moves the body rigidly, together with its motion.
TEST_P(EveryMotionModel, AChangeOfTheGlobalPoseKeepsTheMotion) {
  const MotionContext context = walking_.context(kDt);
  std::vector<WalkerParticle> set = walkers_on_their_way(context, 50);
  const GlobalPoseSpread spread = global_pose_spread(set, std::vector<double>(set.size(), 0.0));
  for (WalkerParticle& p : set) {
    const double moved = (p.pose.root - p.pose_before.root).head<2>().norm();
    Rng rng(5, Purpose::kTest);
    move_global_pose(context, spread, 0.5, p, rng);
    EXPECT_NEAR((p.pose.root - p.pose_before.root).head<2>().norm(), moved, 1e-9);
  }
}

TEST_P(EveryMotionModel, ParticlesStartWhereTheWalkIsDetected) {
  const MotionContext context = walking_.context(kDt);
  for (const WalkerParticle& p : walkers(context, 1.3, 20))
    EXPECT_NEAR(p.pose.root.head<2>().norm(), 0, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(KneedAnthropomorphicMarkov, EveryMotionModel,
                         testing::Values(MotionKind::kKneed, MotionKind::kAnthropomorphic,
                                         MotionKind::kMarkov));

}  // namespace
}  // namespace walktrack
