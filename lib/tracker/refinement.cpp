#include "tracker/refinement.h"

#include <algorithm>
#include <utility>

#include "body/kinematics.h"
#include "core/conventions.h"
#include "core/parallel_for.h"
#include "filter/map_estimate.h"
#include "tracker/frame_likelihood.h"

namespace walktrack {

namespace {

constexpr int kMostNumbers = 22;  // of a pose with arms
constexpr int kRounds = 4;

using Numbers = BoundedVector<kMostNumbers>;

struct FreeNumber {
  double Pose::*of_body = nullptr;
  double LegPose::*of_leg = nullptr;
  double ArmPose::*of_arm = nullptr;
  double sd = 0;  // rad; how far people stray from the particles' mean
  bool sideways = false;
};

constexpr double kRootSd = 0.02, kRootHeightSd = 0.01;  // m

// Angles that are free, by body, leg and arm; those that are sideways stay on a sagittal path.
constexpr std::array kOfBody{FreeNumber{.of_body = &Pose::heading, .sd = 0.09, .sideways = true},
                             FreeNumber{.of_body = &Pose::list, .sd = 0.035, .sideways = true},
                             FreeNumber{.of_body = &Pose::tilt, .sd = 0.05}};
constexpr std::array kOfLeg{
    FreeNumber{.of_leg = &LegPose::hip_flexion, .sd = 0.09},
    FreeNumber{.of_leg = &LegPose::hip_abduction, .sd = 0.05, .sideways = true},
    FreeNumber{.of_leg = &LegPose::hip_rotation, .sd = 0.09, .sideways = true},
    FreeNumber{.of_leg = &LegPose::knee_flexion, .sd = 0.14},
    FreeNumber{.of_leg = &LegPose::ankle_dorsiflexion, .sd = 0.17}};
constexpr std::array kOfArm{
    FreeNumber{.of_arm = &ArmPose::shoulder_flexion, .sd = 0.26},
    FreeNumber{.of_arm = &ArmPose::shoulder_abduction, .sd = 0.17, .sideways = true},
    FreeNumber{.of_arm = &ArmPose::elbow_flexion, .sd = 0.26}};

// Calls f(number, sd) for every number of the pose that is free in this model, in a fixed order.
template <typename F>
void for_each_free(const BodyModel& model, Pose& pose, const F& f) {
  f(pose.root.x(), kRootSd);
  f(pose.root.y(), kRootSd);
  f(pose.root.z(), kRootHeightSd);
  const auto is_free = [&](const FreeNumber& number) { return turns(model) || !number.sideways; };
  for (const FreeNumber& number : kOfBody)
    if (is_free(number)) f(pose.*number.of_body, number.sd);
  for (LegPose& leg : pose.legs)
    for (const FreeNumber& number : kOfLeg)
      if (is_free(number)) f(leg.*number.of_leg, number.sd);
  if (!model.body.groups.arms) return;
  for (ArmPose& arm : pose.arms)
    for (const FreeNumber& number : kOfArm)
      if (is_free(number)) f(arm.*number.of_arm, number.sd);
}

struct Prior {
  Numbers mean, sd;
};

Prior prior_about(const BodyModel& model, Pose pose) {
  Eigen::Index count = 0;
  for_each_free(model, pose, [&](double&, double) { ++count; });
  Prior out{Numbers(count), Numbers(count)};
  Eigen::Index k = 0;
  for_each_free(model, pose, [&](double& number, double sd) {
    out.mean[k] = number;
    out.sd[k++] = sd;
  });
  return out;
}

Pose with_numbers(const BodyModel& model, Pose pose, const Numbers& numbers) {
  Eigen::Index k = 0;
  for_each_free(model, pose, [&](double& number, double) { number = numbers[k++]; });
  for (LegPose& leg : pose.legs) leg.knee_flexion = std::max(0.0, leg.knee_flexion);
  return pose;
}

double log_likelihood(const FrameLikelihood& likelihood, const Pose& pose) {
  WalkerParticle particle;
  particle.pose = particle.pose_before = pose;
  const FrameLikelihood::Account account = likelihood(particle);
  double sum = 0;
  for (int stage = 0; stage < likelihood.stages(); ++stage) sum += account(stage);
  return sum;
}

void move(const JointPositions& from, const JointPositions& to, size_t count,
          JointPositions& joints) {
  for (size_t j = 0; j < count; ++j) joints.at[j] += to.at[j] - from.at[j];
}

}  // namespace

void refine(const TrackerScene& scene, const SceneEvidence& evidence, int threads,
            FrameRecord& record) {
  if (!record.tracked) return;
  const BodyModel& model = scene.model;
  // Flow would ask for a pose before this one, which has been refined, too.
  const FrameLikelihood likelihood(scene, evidence, false);
  const Pose mean = record.estimate.pose;
  const Prior prior = prior_about(model, mean);
  const auto log_likelihoods = [&](std::span<const Numbers> points, std::span<double> values) {
    parallel_for(points.size(), threads, [&](size_t i) {
      values[i] = log_likelihood(likelihood, with_numbers(model, mean, points[i]));
    });
  };
  const auto found = map_estimate<kMostNumbers>(prior.mean, prior.sd, kRounds, log_likelihoods);
  const Pose pose = with_numbers(model, mean, found.at);
  const JointPositions from = forward_kinematics(model.body, mean).joints,
                       to = forward_kinematics(model.body, pose).joints;
  const FrameEstimate before = record.estimate;
  record.estimate.pose = pose;
  move(from, to, before.joint_count, record.estimate.joints);
  shift_bands(before, record.estimate);
  for (JointPositions& sample : record.samples) move(from, to, before.joint_count, sample);
}

}  // namespace walktrack
