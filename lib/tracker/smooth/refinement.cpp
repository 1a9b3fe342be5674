#include "tracker/smooth/refinement.h"

#include <utility>

#include "body/kinematics.h"
#include "core/parallel_for.h"
#include "filter/map_estimate.h"
#include "tracker/frame_likelihood.h"
#include "tracker/smooth/distance_information.h"
#include "tracker/state/free_numbers.h"

namespace walktrack {
inline namespace tracker {

namespace {

using Numbers = Eigen::VectorXd;

// Rounds of the climb. By hand.
constexpr int kRounds = 4;

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
  const FreeNumbers free = free_numbers(model);
  const auto log_likelihoods = [&](std::span<const Numbers> points, std::span<double> values) {
    parallel_for(points.size(), threads, [&](size_t i) {
      values[i] = log_likelihood(likelihood, with_values(free, mean, points[i]));
    });
  };
  const auto found =
      map_estimate(values_of(free, mean), spreads_of(free), kRounds, log_likelihoods);
  const Pose pose = with_values(free, mean, found.at);
  const JointPositions from = forward_kinematics(model.body, mean).joints,
                       to = forward_kinematics(model.body, pose).joints;
  const FrameEstimate before = record.estimate;
  record.estimate.pose = pose;
  record.images = {mean, pose, {}};
  if (!found.information.isZero()) {
    Eigen::MatrixXd information = found.information;
    // Frames of somebody who stands show the same error of the outline again and again, and their
    // sum would be believed.
    const bool stands = record.modes.standing > 0.5;
    if (scene.cameras.size() == 1 && !stands) {
      information = with_distance(
          scene.cameras[0], free, pose,
          [&](const Pose& at) { return log_likelihood(likelihood, at); }, std::move(information));
    }
    record.images.information = packed(free, information);
  }
  move(from, to, before.joint_count, record.estimate.joints);
  shift_bands(before, record.estimate);
  for (JointPositions& sample : record.samples) move(from, to, before.joint_count, sample);
}

}  // namespace tracker
}  // namespace walktrack
