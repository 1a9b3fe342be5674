#include "tracker/smooth/joint_fit.h"

#include <cmath>

#include <gtest/gtest.h>

#include "body/kinematics.h"
#include "core/rng.h"
#include "fixture.h"

namespace walktrack {
namespace {

Pose striding() {
  Pose pose;
  pose.root = {1, 2, 0.9};
  pose.heading = 0.7;
  pose.tilt = 0.1;
  pose.legs[0] = {0.5, 0.05, 0.1, 0.6, 0.1};
  pose.legs[1] = {-0.3, 0.02, -0.1, 0.4, -0.1};
  return pose;
}

TEST(JointFit, FindsThePoseOfItsOwnJoints) {
  const BodyModel model = test_model();
  const Pose pose = striding();
  const auto fit = fit_joints(model, forward_kinematics(model.body, pose).joints, 0.02);
  ASSERT_TRUE(fit);
  EXPECT_LT(difference(free_numbers(model), pose, fit->pose).norm(), 1e-6);
}

// A law: joints that are moved as a whole move the fitted figure, and change nothing else of it.
TEST(JointFit, MovesWithTheJoints) {
  const BodyModel model = test_model();
  JointPositions joints = forward_kinematics(model.body, striding()).joints;
  Rng rng(1, Purpose::kTest);
  for (Eigen::Vector3d& joint : joints.at)
    joint += 0.01 * Eigen::Vector3d(rng.normal(), rng.normal(), rng.normal());
  const Pose before = fit_joints(model, joints, 0.02)->pose;
  for (Eigen::Vector3d& joint : joints.at) joint += Eigen::Vector3d(0.3, -0.2, 0.1);
  Pose after = fit_joints(model, joints, 0.02)->pose;
  EXPECT_LT((after.root - before.root - Eigen::Vector3d(0.3, -0.2, 0.1)).norm(), 1e-6);
  after.root = before.root;
  EXPECT_LT(difference(free_numbers(model), before, after).norm(), 1e-6);
}

TEST(JointFit, NeedsHipsKneesAndAnkles) {
  const BodyModel model = test_model();
  JointPositions joints = forward_kinematics(model.body, striding()).joints;
  joints[Joint::kLeftToe].setConstant(std::nan(""));
  EXPECT_TRUE(fit_joints(model, joints, 0.02));
  joints[Joint::kRightAnkle].setConstant(std::nan(""));
  EXPECT_FALSE(fit_joints(model, joints, 0.02));
}

TEST(JointFit, TakesLengthsFromTheMotionUnlessStated) {
  Subject subject;
  subject.lengths.shank = 0.44;
  Subject other = subject;
  other.lengths.thigh = 0.5;
  other.lengths.shank = 0.39;
  const Body body = make_body(other, {});
  Motion motion{{0}, {forward_kinematics(body, striding()).joints}};
  for (const Joint joint : {Joint::kLeftShoulder, Joint::kRightShoulder})
    motion.joints[0][joint].setConstant(std::nan(""));
  const Subject found = with_lengths_of(motion, subject);
  EXPECT_NEAR(*found.lengths.thigh, 0.5, 1e-9);
  EXPECT_EQ(*found.lengths.shank, 0.44);
  EXPECT_NEAR(*found.lengths.hip_width, body.lengths.hip_width, 1e-9);
  EXPECT_FALSE(found.lengths.trunk);  // unknown, as the shoulders are
  other.lengths.trunk = 0.55;
  other.lengths.forearm = 0.21;
  const Body armed = make_body(other, {.head = true, .arms = true});
  const Subject whole =
      with_lengths_of({{0}, {forward_kinematics(armed, striding()).joints}}, subject);
  EXPECT_NEAR(*whole.lengths.trunk, 0.55, 1e-9);
  EXPECT_NEAR(*whole.lengths.forearm, 0.21, 1e-9);
  EXPECT_NEAR(*whole.lengths.shoulder_width, armed.lengths.shoulder_width, 1e-9);
}

// Two normal distributions and the walker's prior: what both together say has its maximum where the
// gradients of all three cancel.
TEST(ImageInformation, TakesUpOtherEvidence) {
  const BodyModel model = test_model();
  const FreeNumbers free = free_numbers(model);
  const Eigen::VectorXd s = spreads_of(free);
  Pose walker = striding(), peak = walker, given = walker;
  peak.root.x() += 0.01;
  given.root.x() -= 0.03;
  given.legs[0].knee_flexion += 0.1;
  const Eigen::MatrixXd h = (4 * s.cwiseAbs2().cwiseInverse()).asDiagonal();
  const Eigen::MatrixXd g = (9 * s.cwiseAbs2().cwiseInverse()).asDiagonal();
  // The frame's most probable pose: 4 parts of the images' peak, 1 of the walker.
  ImageInformation images{walker, walker, packed(free, h)};
  images.pose.root.x() += 0.8 * 0.01;
  add_information(free, given, g, images);
  EXPECT_NEAR(images.pose.root.x() - walker.root.x(), (4 * 0.01 - 9 * 0.03) / 14, 1e-9);
  EXPECT_NEAR(images.pose.legs[0].knee_flexion - walker.legs[0].knee_flexion, 9 * 0.1 / 14, 1e-9);
  EXPECT_LT((unpacked(free, images) - h - g).norm(), 1e-6 * h.norm());
}

}  // namespace
}  // namespace walktrack
