#include "tracker/smooth/refinement.h"

#include <algorithm>

#include "body/kinematics.h"
#include "body/pose_numbers.h"
#include "core/parallel_for.h"
#include "filter/map_estimate.h"
#include "tracker/frame_likelihood.h"

namespace walktrack {
inline namespace tracker {

namespace {

using Numbers = Eigen::VectorXd;

// Rounds of the climb. By hand.
constexpr int kRounds = 4;

// Calls f(number) for every number of the pose that is free in this model, in a fixed order. Those
// that are sideways stay on a sagittal path.
template <typename F>
void for_each_free(const BodyModel& model, const F& f) {
  for (const PoseNumber& number : kPoseNumbers) {
    if (number.sideways && !turns(model)) continue;
    if (number.limb() == Limb::kArm && !model.body.groups.arms) continue;
    f(number);
  }
}

struct Prior {
  Numbers mean, sd;
};

Prior prior_about(const BodyModel& model, const Pose& pose) {
  Eigen::Index count = 0;
  for_each_free(model, [&](const PoseNumber&) { ++count; });
  Prior out{Numbers(count), Numbers(count)};
  Eigen::Index k = 0;
  for_each_free(model, [&](const PoseNumber& number) {
    out.mean[k] = number.in(pose);
    out.sd[k++] = number.spread;
  });
  return out;
}

Pose with_numbers(const BodyModel& model, Pose pose, const Numbers& numbers) {
  Eigen::Index k = 0;
  for_each_free(model, [&](const PoseNumber& number) {
    number.in(pose) = std::max(number.lowest, numbers[k++]);
  });
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

}  // namespace tracker
}  // namespace walktrack
