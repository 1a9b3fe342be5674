// The first particles: a walker seen at a place, walking some way, may be in any phase of either
// leg's step. They are drawn by hypotheses over phase and side, which then compete
// (tracker/start/start_hypotheses.h).
#pragma once

#include <vector>

#include "tracker/detect/detector.h"
#include "tracker/motion/propagate.h"

namespace walktrack {
inline namespace tracker {

struct StartConfig {
  int phases = 6;        // hypotheses over the phase of a step, for each standing foot
  int particles = 150;   // of each hypothesis
  double seconds = 0.5;  // for which they compete
  // Standard deviations. By hand, about as wide as detected walks are off; not tuned.
  double heading_deg = 6;
  double speed = 0.15;        // relative
  double step_length = 0.12;  // relative, about the human relation
};

// Which part of the stride a hypothesis covers: a standing foot and phases [from, to) of its step.
struct PhaseRange {
  Side stance = Side::kLeft;
  double from = 0, to = 1;
};
std::vector<PhaseRange> phase_ranges(const StartConfig& config);
// The ranges that hold a stated phase of the stride (0 = left foot strike), give or take a range.
std::vector<PhaseRange> phase_ranges(const StartConfig& config, double stride_phase);

// Particles drawn around a detected walk; their noise is still to be drawn by a first frame.
std::vector<WalkerParticle> spawn(const MotionContext& context, const StartConfig& config,
                                  const DetectedWalk& detected, const PhaseRange& range,
                                  uint64_t seed);

// The noise of a first frame: as wide as the detection is coarse. `motion`: to the body's scale.
NoiseScale start_scale(const StartConfig& config, const MotionModel& moves,
                       const MotionConfig& motion, const NoiseScale& frame);

}  // namespace tracker
}  // namespace walktrack
