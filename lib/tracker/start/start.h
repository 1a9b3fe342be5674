// The first particles. A walker that was detected at a place with a direction may be in any phase
// of a step of either leg. Particles are drawn for hypotheses over phase and side, which then
// compete (tracker/start/start_hypotheses.h).
#pragma once

#include <vector>

#include "tracker/detect/detected_walk.h"
#include "tracker/motion/propagate.h"

namespace walktrack {
inline namespace tracker {

struct StartConfig {
  int phases = 6;        // hypotheses over the phase of a step, for each stance foot
  int particles = 150;   // particles of each hypothesis
  double seconds = 0.5;  // s for which they compete
  // Standard deviations. By hand, about as large as the errors of detected walks; not tuned.
  double heading_deg = 6;
  double speed = 0.15;        // relative
  double step_length = 0.12;  // relative, about the human relation
};

// The part of the stride that a hypothesis covers: a stance foot and phases [from, to) of its step.
struct PhaseRange {
  Side stance = Side::kLeft;
  double from = 0, to = 1;
};
std::vector<PhaseRange> phase_ranges(const StartConfig& config);
// All phases that are at most the length of a range from a stated phase of the stride (0 = left
// foot strike): two ranges where these reach into the step before or after.
std::vector<PhaseRange> phase_ranges(const StartConfig& config, double stride_phase);

// Particles drawn around a detected walk; the first frame still has to draw their noise.
std::vector<WalkerParticle> spawn(const MotionContext& context, const StartConfig& config,
                                  const DetectedWalk& detected, const PhaseRange& range,
                                  uint64_t seed);

// The noise of a first frame, whose spread is the uncertainty of the detection. `motion`: at the
// body's scale.
NoiseScale start_scale(const StartConfig& config, const MotionModel& moves,
                       const MotionConfig& motion, const NoiseScale& frame);

}  // namespace tracker
}  // namespace walktrack
