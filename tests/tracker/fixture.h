// A subject with its walker and its gaits, for the tests of the tracker.
#pragma once

#include "body/kinematics.h"
#include "core/conventions.h"
#include "tests/motion_context.h"
#include "tracker/motion/models/kneed_motion.h"
#include "tracker/motion/models/make_motion_model.h"
#include "tracker/motion/models/planar_body.h"
#include "tracker/motion/propagate.h"
#include "tracker/start/start.h"
#include "tracker/tracker_scene.h"
#include "tracker/walker_filter.h"

namespace walktrack {

inline BodyModel test_model(Path path = Path::kSpatial) {
  BodyModel model;
  model.path = path;
  model.body = make_body(Subject{}, {.head = true, .arms = false});
  model.walker = kneed_model(kneed_parameters(Subject{}, kStandardGravity));
  return model;
}

// The objects to which a context refers.
struct Walking {
  explicit Walking(MotionKind kind = MotionKind::kKneed, Path path = Path::kSpatial)
      : model(test_model(path)), moves(make_motion_model(kind, model, prior)) {}
  BodyModel model;
  GaitPrior prior = load_gait_prior();
  std::unique_ptr<const MotionModel> moves;
  MotionContext context(double dt, const MotionConfig& config = {}) const {
    return motion_context(model, prior, *moves, config, dt);
  }
};

// Without the noise that it drew.
inline void silence(const MotionContext& context, WalkerParticle& particle) {
  particle.noise.fill(0);
  context.moves.apply_noise(context, particle);
}

// A scene without cameras and evidence.
inline TrackerScene unseen(const BodyModel& model, double dt) {
  TrackerScene scene;
  scene.model = model;
  scene.dt = dt;
  return scene;
}

// Particles that walk along +x through the origin at a speed, m/s.
inline std::vector<WalkerParticle> walkers(const MotionContext& context, double speed, int count) {
  StartConfig start;
  start.particles = count;
  const DetectedWalk detected{.position = {0, 0}, .velocity = {speed, 0}};
  return spawn(context, start, detected, {Side::kLeft, 0.0, 1.0}, 7);
}

// The same after their first two frames.
inline std::vector<WalkerParticle> walkers_on_their_way(const MotionContext& context, int count) {
  std::vector<WalkerParticle> set = walkers(context, 1.3, count);
  for (size_t i = 0; i < set.size(); ++i) {
    Rng rng(5, Purpose::kTorque, 0, static_cast<uint32_t>(i));
    draw_first_noise(context, set[i], rng);
    propagate(context, set[i], rng);
  }
  return set;
}

// A tracked frame with that pose, of a body with or without arms: bands from 2 cm below to 3 cm
// above each coordinate, two samples.
inline FrameRecord record_of(const Body& body, const Pose& pose) {
  FrameRecord record;
  record.tracked = true;
  FrameEstimate& estimate = record.estimate;
  estimate.joint_count = body.groups.arms ? size_t{kJointCount} : kJointCountWithoutArms;
  estimate.pose = pose;
  estimate.joints = forward_kinematics(body, pose).joints;
  for (size_t j = 0; j < estimate.joint_count; ++j) {
    for (size_t axis = 0; axis < 3; ++axis) {
      const double at = estimate.joints.at[j][static_cast<Eigen::Index>(axis)];
      estimate.spread[j][axis] = {at, 0.015, at - 0.02, at + 0.03};
    }
  }
  record.samples.assign(2, estimate.joints);
  return record;
}

}  // namespace walktrack
