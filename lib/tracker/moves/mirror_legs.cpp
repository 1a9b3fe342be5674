#include "tracker/moves/mirror_legs.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tracker/modes/stride_modes.h"

namespace walktrack {
inline namespace tracker {

namespace {

// For legs that reach across the pelvis to each other's feet, abductions become this much less than
// the negative of the other leg's, rad (to first order).
double reach(const Body& body) { return body.lengths.hip_width / leg_length(body.lengths); }

void swap_residuals(ResidualAngles& residual) {
  for (const ResidualRow& row : kResidualTable)
    if (row.paired()) std::swap(residual[row.left], residual[row.right]);
}

void reach_across(double reach, ResidualAngles& residual) {
  for (const ResidualAngle i : {kAbduction, kAbductionRight}) residual[i] = -residual[i] - reach;
}

// Pairs below the hips and the shoulders.
constexpr std::pair<Joint, Joint> kPairs[] = {{Joint::kLeftKnee, Joint::kRightKnee},
                                              {Joint::kLeftAnkle, Joint::kRightAnkle},
                                              {Joint::kLeftToe, Joint::kRightToe},
                                              {Joint::kLeftElbow, Joint::kRightElbow},
                                              {Joint::kLeftWrist, Joint::kRightWrist}};

// `middle`: of the mirrored pose. About them the angles spread as the other leg's did.
void swap_angles(const JointAngles& middle, std::array<Spread, kJointAngleCount>& angles) {
  constexpr int kOther = kHipFlexionL - kHipFlexionR;
  for (int i = kHipFlexionR; i <= kAnkleAngleR; ++i)
    std::swap(angles[size_t(i)], angles[size_t(i + kOther)]);
  for (const JointAngle i : {kHipAdductionR, kHipAdductionL}) {
    Spread& each = angles[size_t(i)];
    each = {-each.mean, each.sd, -each.p95, -each.p05};
  }
  for (int i = kHipFlexionR; i <= kAnkleAngleL; ++i) {
    Spread& each = angles[size_t(i)];
    const double shift = middle[size_t(i)] - each.mean;
    each = {middle[size_t(i)], each.sd, each.p05 + shift, each.p95 + shift};
  }
}

Pose swapped_limbs(const Pose& pose) {
  Pose out = pose;
  std::swap(out.legs[0], out.legs[1]);
  std::swap(out.arms[0], out.arms[1]);
  return out;
}

// For legs that do not reach sideways: the pelvis stays in its place, and the feet swap their
// places.
void swap_feet(const MotionContext& context, WalkerParticle& particle) {
  const Eigen::Vector2d root = particle.pose.root.head<2>();
  context.moves.apply_noise(context, particle);
  particle.predicted_ball += root - particle.pose.root.head<2>();
  context.moves.apply_noise(context, particle);
  particle.pose_before = swapped_limbs(particle.pose_before);
}

bool stands(const FrameRecord& record) { return record.modes.standing > 0.5; }

}  // namespace

void swap_legs(JointPositions& joints) {
  for (const auto& [left, right] : kPairs) std::swap(joints[left], joints[right]);
}

Pose mirrored_legs(const Body& body, const Pose& pose) {
  Pose out = swapped_limbs(pose);
  for (LegPose& leg : out.legs) leg.hip_abduction = -leg.hip_abduction - reach(body);
  return out;
}

void mirror_legs(const MotionContext& context, WalkerParticle& particle) {
  const Body& body = context.model.body;
  const bool reaches = context.model.path == Path::kSpatial;
  particle.stance = other(particle.stance);
  for (ResidualAngles* residual :
       {&particle.predicted_residual, &particle.residual_before, &particle.residual}) {
    swap_residuals(*residual);
    if (reaches) reach_across(reach(body), *residual);
  }
  ResidualAngles noise;
  std::copy_n(particle.noise.begin() + kResidualNoise, kResidualCount, noise.begin());
  swap_residuals(noise);
  if (reaches) reach_across(0, noise);
  std::copy_n(noise.begin(), kResidualCount, particle.noise.begin() + kResidualNoise);
  if (!reaches) return swap_feet(context, particle);
  context.moves.apply_noise(context, particle);
  particle.pose_before = mirrored_legs(body, particle.pose_before);
}

void mirror_legs(const MotionContext& context, WalkerFilter& filter) {
  FilterState<WalkerParticle> state = filter.state();
  for (WalkerParticle& particle : state.set.states) mirror_legs(context, particle);
  filter.resume(std::move(state));
}

void mirror_legs(const Body& body, FrameRecord& record) {
  FrameEstimate& estimate = record.estimate;
  estimate.pose = mirrored_legs(body, estimate.pose);
  for (Pose* pose : {&record.images.walker, &record.images.pose})
    *pose = mirrored_legs(body, *pose);
  mirror_information(record.images);
  swap_legs(estimate.joints);
  for (const auto& [left, right] : kPairs)
    std::swap(estimate.spread[size_t(left)], estimate.spread[size_t(right)]);
  swap_angles(joint_angles(estimate.pose), estimate.angles);
  estimate.left_stance = 1 - estimate.left_stance;
  for (JointPositions& sample : record.samples) swap_legs(sample);
  record.modes.phase = std::fmod(record.modes.phase + 0.5, 1.0);
}

bool relabel_before_switch(const Body& body, std::span<FrameRecord> records) {
  if (records.size() < 2 || !records.back().tracked) return false;
  const std::span before = records.first(records.size() - 1);
  if (stands(records.back()) || stands(before.back())) return false;
  const double phase = records.back().modes.phase, phase_before = before.back().modes.phase;
  if (mirrored(phase_before, phase)) {
    const auto stood = std::find_if(before.rbegin(), before.rend(), stands);
    std::for_each(stood.base(), before.end(),
                  [&](FrameRecord& record) { mirror_legs(body, record); });
  }
  return apart(phase_before, phase);
}

}  // namespace tracker
}  // namespace walktrack
