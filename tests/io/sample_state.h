// A small valid state of a track: one camera, two particles, one of them dead.
#pragma once

#include <limits>

#include "io/archive/checkpoint_file.h"

namespace walktrack {

inline ObserverState sample_observer() {
  ObserverState out;
  out.background =
      BackgroundModel{2, 1, {{2, 1.5F}, true}, 0.25, {.1f, .2f}, {0, 0}, {0, 0}, {1, 1}, {1, 1}};
  out.grey_before = {3, 1, {1, 2, 3}};
  out.errors.scale[2] = 0.25;
  out.use.matched = 9;
  out.frames = 7;
  return out;
}

inline TrackerState sample_tracker() {
  TrackerState out;
  ParticleSet<WalkerParticle>& set = out.filter.set;
  set.states.resize(2);
  set.states[0].pose.heading = 0.5;
  set.states[0].stance = Side::kRight;
  set.log_weights = {-0.5, -std::numeric_limits<double>::infinity()};
  set.log_likelihoods = set.log_weights;
  out.filter.scale = 0.25;
  out.monitor.log_likelihoods = {1, 2};
  out.monitor.last_seen = LastSeen{{1, 2}, {3, 4}, 6};
  const Eigen::Matrix4d covariance = 0.25 * Eigen::Matrix4d::Identity();
  out.people.subject = {{1, 2, 0.5, 1}, covariance};
  out.people.usual_score = 40;
  out.people.frames = 9;
  out.frames_beside_others = 4;
  out.estimates.girth = 1.25;
  out.estimates.trunk = 0.45;
  out.people.others = {{{{3, 2, 0, -1}, covariance}, 5, 2}};
  return out;
}

inline Checkpoint sample_checkpoint(const Origin& origin) {
  return {origin,
          7,
          5,
          1234,
          {sample_observer()},
          {{{1, 2, 3, 4}, .01, true, true, {2, 2, 3, 4}}},
          sample_tracker()};
}

inline FrameRecord sample_record() {
  FrameRecord out;
  out.tracked = true;
  out.estimate.joint_count = kJointCountWithoutArms;
  for (Eigen::Vector3d& joint : out.estimate.joints.at) joint.setZero();
  out.estimate.spread[3][1] = {1, 2, 3, 4};
  out.estimate.left_stance = 0.5;
  out.samples.assign(2, out.estimate.joints);
  return out;
}

}  // namespace walktrack
