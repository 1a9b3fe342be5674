#include "tracker/smooth/refinement.h"

#include <cmath>

#include <gtest/gtest.h>

#include "body/kinematics.h"
#include "fixture.h"
#include "made_evidence.h"
#include "tests/observation/scenes.h"

namespace walktrack {
namespace {

Pose mid_stride() {
  Pose pose;
  pose.root = {0, 0, 0.9};
  pose.heading = 0.05;
  pose.tilt = 0.05;
  pose.legs[0] = {0.45, 0.03, 0, 0.2, 0.05};
  pose.legs[1] = {-0.25, 0.03, 0, 0.5, -0.1};
  return pose;
}

// As far from the truth as particles usually are.
Pose nearby(Pose pose) {
  pose.root += Eigen::Vector3d(0.015, 0, 0.005);
  pose.legs[0].hip_flexion -= 0.06;
  pose.legs[0].knee_flexion += 0.12;
  pose.legs[1].hip_flexion += 0.05;
  pose.legs[1].knee_flexion -= 0.12;
  pose.legs[1].ankle_dorsiflexion += 0.15;
  return pose;
}

class Refined : public testing::Test {
 protected:
  void show(const Pose& pose, const Eigen::Vector3d& from) {
    scene.cameras.push_back(camera_at(from, {0, 0, 0.9}, 300, kEvidenceWidth, kEvidenceHeight));
    evidence.push_back(evidence_of(scene.cameras.back(), scene.model.body, pose));
  }

  FrameRecord record_of(const Pose& pose) const {
    return walktrack::record_of(scene.model.body, pose);
  }

  TrackerScene scene = unseen(test_model(), 1.0 / 30);
  SceneEvidence evidence;
};

// Mean over both legs' hips and knees, rad.
double off(const Pose& pose, const Pose& truth) {
  double sum = 0;
  for (size_t i = 0; i < 2; ++i) {
    sum += std::abs(pose.legs[i].hip_flexion - truth.legs[i].hip_flexion);
    sum += std::abs(pose.legs[i].knee_flexion - truth.legs[i].knee_flexion);
  }
  return sum / 4;
}

TEST_F(Refined, PosesComeCloseToWhatIsSeen) {
  const Pose truth = mid_stride();
  show(truth, {0, -4, 1});
  show(truth, {3, -3, 1.5});
  const FrameRecord before = record_of(nearby(truth));
  FrameRecord after = before;
  refine(scene, evidence, 1, after);
  EXPECT_LT(off(after.estimate.pose, truth), 0.5 * off(before.estimate.pose, truth));
  EXPECT_LT((after.estimate.pose.root - truth.root).norm(), 0.005);
  const JointPositions drawn = forward_kinematics(scene.model.body, after.estimate.pose).joints;
  for (size_t j = 0; j < kJointCountWithoutArms; ++j) {
    EXPECT_LT((after.estimate.joints.at[j] - drawn.at[j]).norm(), 1e-9);
    EXPECT_EQ(after.samples[1].at[j], after.estimate.joints.at[j]);
    EXPECT_NEAR(after.estimate.spread[j][0].p95, drawn.at[j].x() + 0.03, 1e-9);
  }
}

TEST_F(Refined, TheSameForAnyThreadCount) {
  show(mid_stride(), {0, -4, 1});
  FrameRecord one = record_of(nearby(mid_stride())), four = one;
  refine(scene, evidence, 1, one);
  refine(scene, evidence, 4, four);
  for (size_t j = 0; j < kJointCountWithoutArms; ++j)
    EXPECT_EQ(one.estimate.joints.at[j], four.estimate.joints.at[j]);
}

TEST_F(Refined, TheWalkersPoseIsKeptWithoutEvidence) {
  const FrameRecord before = record_of(nearby(mid_stride()));
  FrameRecord after = before;
  refine(scene, evidence, 1, after);
  EXPECT_EQ(after.estimate.pose.root, before.estimate.pose.root);
  EXPECT_EQ(off(after.estimate.pose, before.estimate.pose), 0);
  show(mid_stride(), {0, -4, 1});
  after.tracked = false;
  refine(scene, evidence, 1, after);
  EXPECT_EQ(off(after.estimate.pose, before.estimate.pose), 0) << "not tracked";
}

TEST_F(Refined, NothingTurnsOutOfASagittalPath) {
  scene.model = test_model(Path::kSagittal);
  const Pose truth = mid_stride();
  show(truth, {0, -4, 1});
  Pose pose = nearby(truth);
  pose.heading += 0.03;
  FrameRecord record = record_of(pose);
  refine(scene, evidence, 1, record);
  EXPECT_EQ(record.estimate.pose.heading, pose.heading);
  EXPECT_EQ(record.estimate.pose.list, pose.list);
  for (size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(record.estimate.pose.legs[i].hip_abduction, pose.legs[i].hip_abduction);
    EXPECT_EQ(record.estimate.pose.legs[i].hip_rotation, pose.legs[i].hip_rotation);
  }
  EXPECT_LT(off(record.estimate.pose, truth), 0.65 * off(pose, truth)) << "one camera";
}

TEST_F(Refined, ArmsFollowTheirSilhouettesToo) {
  scene.model.body = make_body(Subject{}, {.head = true, .arms = true});
  Pose truth = mid_stride();
  truth.arms[0] = {-0.5, 0.1, 0.3};
  truth.arms[1] = {0.5, 0.1, 0.4};
  show(truth, {0, -4, 1});
  show(truth, {3, -3, 1.5});
  Pose pose = truth;
  pose.arms[0].shoulder_flexion += 0.2;
  pose.arms[1].elbow_flexion -= 0.2;
  FrameRecord record = record_of(pose);
  refine(scene, evidence, 1, record);
  const auto arms_off = [&](const Pose& of) {
    return std::abs(of.arms[0].shoulder_flexion - truth.arms[0].shoulder_flexion) +
           std::abs(of.arms[1].elbow_flexion - truth.arms[1].elbow_flexion);
  };
  EXPECT_LT(arms_off(record.estimate.pose), 0.8 * arms_off(pose));
}

}  // namespace
}  // namespace walktrack
