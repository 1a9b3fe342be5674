#include "tracker/smooth/refinement.h"

#include <algorithm>
#include <array>

#include "body/kinematics.h"
#include "core/parallel_for.h"
#include "filter/map_estimate.h"
#include "tracker/frame_likelihood.h"

namespace walktrack {

namespace {

using Numbers = Eigen::VectorXd;

// Rounds of the climb. By hand.
constexpr int kRounds = 4;
// How far people's poses differ from the particles' mean, m, and below rad. By hand; halved
// 13.1 mm and doubled 14.5 mm on the made walks (reports/reported_pose.md).
constexpr double kRootSd = 0.02, kRootHeightSd = 0.01;

template <typename Part>
struct Angle {
  double Part::*of;
  double sd;  // rad
  bool sideways = false;
};

// Angles that are free; those that are sideways stay on a sagittal path.
constexpr std::array kOfBody{Angle<Pose>{&Pose::heading, 0.09, true},
                             Angle<Pose>{&Pose::list, 0.035, true}, Angle<Pose>{&Pose::tilt, 0.05}};
constexpr std::array kOfLeg{Angle<LegPose>{&LegPose::hip_flexion, 0.09},
                            Angle<LegPose>{&LegPose::hip_abduction, 0.05, true},
                            Angle<LegPose>{&LegPose::hip_rotation, 0.09, true},
                            Angle<LegPose>{&LegPose::knee_flexion, 0.14},
                            Angle<LegPose>{&LegPose::ankle_dorsiflexion, 0.17}};
constexpr std::array kOfArm{Angle<ArmPose>{&ArmPose::shoulder_flexion, 0.26},
                            Angle<ArmPose>{&ArmPose::shoulder_abduction, 0.17, true},
                            Angle<ArmPose>{&ArmPose::elbow_flexion, 0.26}};

// Calls f(number, sd) for every number of the pose that is free in this model, in a fixed order.
template <typename F>
void for_each_free(const BodyModel& model, Pose& pose, const F& f) {
  f(pose.root.x(), kRootSd);
  f(pose.root.y(), kRootSd);
  f(pose.root.z(), kRootHeightSd);
  const auto each = [&](auto& part, const auto& angles) {
    for (const auto& angle : angles)
      if (turns(model) || !angle.sideways) f(part.*angle.of, angle.sd);
  };
  each(pose, kOfBody);
  for (LegPose& leg : pose.legs) each(leg, kOfLeg);
  if (!model.body.groups.arms) return;
  for (ArmPose& arm : pose.arms) each(arm, kOfArm);
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
  const auto found = map_estimate(prior.mean, prior.sd, kRounds, log_likelihoods);
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
