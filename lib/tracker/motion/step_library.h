// Samples of the prior's steps, simulated once: the walker at a moment of a gait is looked up,
// because a simulation would take as long as many frames.
#pragma once

#include <array>
#include <vector>

#include "core/rng.h"
#include "gait/prior/gait_prior.h"
#include "tracker/state/particle.h"

namespace walktrack {
inline namespace tracker {

struct LibraryStep {
  static constexpr size_t kMoments = 24;  // of a step; by hand
  StepAim aim;
  KneedControls controls;
  std::array<KneedState, kMoments>
      moments;  // at equal times, just after the support transfer first
};

// Steps over all speeds and step lengths of the prior's table, on the slopes that a walker can
// meet.
class StepLibrary {
 public:
  StepLibrary(const BodyModel& model, const GaitPrior& prior);

  // A step of about the same speed and length on about the slope of `heading`, drawn with the same
  // probability in both directions; none outside of the table.
  const LibraryStep* near(const StepAim& aim, double heading, Rng& rng) const;

 private:
  double slowest_, speed_step_;   // m/s
  double shortest_, ratio_step_;  // of the preferred step length
  WalkerUnits units_;
  Eigen::Vector2d downhill_;
  std::vector<LibraryStep> steps_;  // by slope, speed and step length, which runs fastest
};

}  // namespace tracker
}  // namespace walktrack
