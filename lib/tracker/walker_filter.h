// One frame of a particle filter over walkers: propagate, weight, move, estimate.
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

// Shares of the particles' weight, given the frame's images, by how walkers came into the frame
// (Continuation); the rest is the walkers' own motion.
struct HistoryShares {
  double jumped = 0, caught = 0;
};

struct FrameRecord {
  bool tracked = false;
  FrameEstimate estimate;
  ImageInformation images;
  FilterReport filter;
  double mean_log_likelihood = 0;       // mean log-likelihood of the particles, nats
  std::vector<JointPositions> samples;  // a few particles that show the spread
  int fallen = 0, diverged = 0;
  HistoryShares history;
  StrideModes modes;
  double names = 0;  // log-odds of the legs' labels by this frame's keypoints, nats
  // By camera: log-likelihood of the best particle by term, nats; NaN if a term has no evidence.
  // Only for tracked frames after the start.
  std::vector<TermValues> evidence;
  // By camera, the keypoints of the frame; empty if there are none.
  std::vector<KeypointEvidence> keypoints;
  FigureFit fit;      // of the pose before it is smoothed and before feet are held in place
  double moving = 0;  // newly covered area in an image while nobody is tracked, m^2
  // The figure was tracked until it had left every picture; then the frame is not tracked.
  bool out_of_picture = false;
};

struct WalkerFilterContext {
  const TrackerScene& scene;
  MotionContext motion;
  int samples;  // particles of a frame that are kept
  int threads;
  double model_error = 1;  // factor on the deviations that tracker/smooth/model_error.h adds
};

// Advances `filter` to frame number `frame`. `first`: the particles have just been drawn, and only
// their noise is added. If no particle survives, the record is one of a frame that is not tracked.
FrameRecord advance(const WalkerFilterContext& context, const SceneEvidence& evidence,
                    uint32_t frame, uint64_t seed, bool first, WalkerFilter& filter);

}  // namespace tracker
}  // namespace walktrack
