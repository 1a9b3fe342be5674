#include "kinetics/linked_body.h"

#include <gtest/gtest.h>

#include "sample_motions.h"

namespace walktrack {
namespace {

TEST(LinkedBody, WeighsWhatTheSubjectWeighsWithAndWithoutArms) {
  for (const bool arms : {false, true}) {
    const JointPositions joints = joints_of(standing(), arms);
    const LinkedBody body = linked_body(Subject{}, {&joints, 1});
    EXPECT_NEAR(body.tree.mass(), Subject{}.mass, 1e-9);
    EXPECT_EQ(body.links.size(), arms ? 12u : 8u);
  }
}

// Computed by hand from Winter's table, in statures above the ground: HAT .678 M at .700 (.626 of
// the distance from hip to shoulder above the hips with arms raised, slightly less with hanging
// arms), thighs .200 M at .424, shanks .093 M at .178, feet .029 M at .02: .577.
TEST(LinkedBody, HasItsCentreWhereTablesPutIt) {
  const JointPositions joints = joints_of(standing());
  const LinkedBody body = linked_body(Subject{}, {&joints, 1});
  const std::vector<LinkedState> states =
      linked_states(body, std::vector<JointPositions>(3, joints), 0.01);
  const BodyMomentum momentum = body_momentum(body.tree, states[0].q, states[0].u);
  EXPECT_NEAR(momentum.com.z() / Subject{}.height, 0.577, 0.005);
  const MassProperties& trunk = body.tree.parts()[1].mass;
  const MassProperties& pelvis = body.tree.parts()[0].mass;
  const double hat =
      (trunk.mass * trunk.com.z() + pelvis.mass * pelvis.com.z()) / (trunk.mass + pelvis.mass);
  EXPECT_NEAR(hat / body_lengths(Subject{}).trunk, 0.626, 0.04);
}

// The tree's own kinematics give every joint's position and velocity in the motion.
TEST(LinkedStates, FollowTheMotion) {
  const Motion motion = motion_by([](double t) { return joints_of(lively(t), true); });
  const LinkedBody body = linked_body(Subject{}, motion.joints);
  const std::vector<LinkedState> states = linked_states(body, motion.joints, 1 / kSampleRate);
  for (const size_t i : {10u, 50u, 90u}) {
    const auto parts = part_motions(body.tree, states[i].q, states[i].u, states[i].u_dot);
    for (size_t k = 0; k < body.links.size(); ++k) {
      const Joint joint = body.links[k].origin;
      EXPECT_LT((parts[k].origin - motion.joints[i][joint]).norm(), 1e-9);
      const Eigen::Vector3d velocity =
          (motion.joints[i + 1][joint] - motion.joints[i - 1][joint]) * kSampleRate / 2;
      EXPECT_LT((parts[k].velocity - velocity).norm(), 0.01);  // dt^2 of either difference
      const Eigen::Vector3d acceleration =
          (motion.joints[i + 1][joint] - 2 * motion.joints[i][joint] +
           motion.joints[i - 1][joint]) *
          kSampleRate * kSampleRate;
      EXPECT_LT((parts[k].acceleration - acceleration).norm(), 0.3);
    }
  }
}

TEST(Linkable, NeedsLegsAndATrunk) {
  JointPositions joints = joints_of(standing());
  EXPECT_TRUE(linkable(joints));
  joints[Joint::kHead].setConstant(NAN);
  EXPECT_TRUE(linkable(joints));
  joints[Joint::kNeck].setConstant(NAN);
  EXPECT_FALSE(linkable(joints));
  joints = joints_of(standing());
  joints[Joint::kLeftToe].setConstant(NAN);
  EXPECT_FALSE(linkable(joints));
}

}  // namespace
}  // namespace walktrack
