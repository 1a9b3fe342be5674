// Fixed work for benchmarks and instruction counts: walkers in the middle of a gait, a figure in
// front of a camera, particles of the tracker. The same on every machine.
#pragma once

#include <memory>
#include <vector>

#include "camera/camera.h"
#include "gait/prior/gait_prior.h"
#include "observation/silhouette/capsules.h"
#include "observation/silhouette/planes.h"
#include "tests/motion_context.h"
#include "tracker/motion/propagate.h"

namespace walktrack {

// Walkers of an average adult at 1.3 m/s, each with its own phase, controls and torque noise.
struct WalkerCrowd {
  GaitPrior prior;
  KneedParameters parameters;
  KneedModel model;
  PriorGait gait;
  std::vector<KneedControls> controls;
  std::vector<Vector5> torques;  // N m
  std::vector<KneedState> states;
};
WalkerCrowd walker_crowd(size_t count);

// Walking figures some 450 px high in front of a 640x480 camera: about 1,200 rows of parts and
// 45,000 pixels each, with planes of log-ratios of three appearances.
struct FigureScene {
  Camera camera;
  Body body;
  std::vector<Pose> poses;
  std::vector<CapsuleList> capsules;  // one for each pose
  LogRatioPlanes planes;
  double mean_rows = 0;  // of the parts, in the image
};
FigureScene figure_scene(size_t poses);

// Particles of the tracker that walk at 1.3 m/s, with 30 frames per second.
struct ParticleScene {
  BodyModel model;
  GaitPrior prior;
  std::unique_ptr<const MotionModel> moves;
  MotionConfig config;
  double dt = 1.0 / 30;  // s
  std::vector<WalkerParticle> particles;

  MotionContext context() const { return motion_context(model, prior, *moves, config, dt); }
};
ParticleScene particle_scene(size_t count);

}  // namespace walktrack
