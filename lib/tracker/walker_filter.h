// One frame of a particle filter over walkers: propagate, weigh, move, and what the particles then
// say.
#pragma once

#include <vector>

#include "filter/particle_filter.h"
#include "tracker/figure_fit.h"
#include "tracker/modes/stride_modes.h"
#include "tracker/motion/propagate.h"
#include "tracker/smooth/estimate.h"
#include "tracker/smooth/image_information.h"
#include "tracker/tracker_scene.h"

namespace walktrack {
inline namespace tracker {

using WalkerFilter = ParticleFilter<WalkerParticle>;

struct FrameRecord {
  bool tracked = false;
  FrameEstimate estimate;
  ImageInformation images;
  FilterReport filter;
  double mean_log_likelihood = 0;       // mean log-likelihood of the particles, nats
  std::vector<JointPositions> samples;  // a few particles, to show their spread
  int fallen = 0, diverged = 0;
  StrideModes modes;
  double names = 0;  // nats that this frame's keypoints speak for the legs' names
  // By camera: what each term says of the best particle, nats; NaN = nothing. Only of tracked
  // frames after the start.
  std::vector<TermValues> evidence;
  // By camera, what a pose detector saw of the frame; empty where none was asked.
  std::vector<KeypointEvidence> keypoints;
  FigureFit fit;      // of the pose before frames around it are heard and feet planted
  double moving = 0;  // m^2 of a picture that are newly covered while nobody is tracked
};

struct WalkerFilterContext {
  const TrackerScene& scene;
  MotionContext motion;
  int samples;  // particles kept of a frame
  int threads;
  double model_error = 1;  // multiplies what tracker/smooth/model_error.h adds to the spreads
};

// Takes `filter` through frame number `frame`. `first`: the particles have just been drawn, and
// only their noise is to be added. The record is not tracked when no particle survives.
FrameRecord advance(const WalkerFilterContext& context, const SceneEvidence& evidence,
                    uint32_t frame, uint64_t seed, bool first, WalkerFilter& filter);

}  // namespace tracker
}  // namespace walktrack
