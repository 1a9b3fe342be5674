// Moments of the prior's steps, simulated once: a walker that is wanted at some moment of some gait
// is looked up, where a simulation would take as long as many frames.
#pragma once

#include <array>
#include <vector>

#include "core/rng.h"
#include "gait/gait_prior.h"
#include "tracker/motion/particle.h"

namespace walktrack {

struct BookedStep {
  static constexpr size_t kMoments = 24;
  StepAim aim;
  KneedControls controls;
  std::array<KneedState, kMoments>
      moments;  // at equal times, just after the support transfer first
};

// Steps over all speeds and step lengths of the prior's table.
class StepBook {
 public:
  StepBook(const KneedModel& model, const GaitPrior& prior);

  // A step of about the same speed and length, drawn as likely there and back; none beyond the
  // table.
  const BookedStep* near(const StepAim& aim, Rng& rng) const;

 private:
  double slowest_, speed_step_;   // m/s
  double shortest_, ratio_step_;  // of the preferred step length
  WalkerUnits units_;
  std::vector<BookedStep> steps_;  // the step length runs fastest
};

}  // namespace walktrack
