// Definitions of events that kneed_advance() and kneed_advance_batch() share; internal to
// lib/walker.
#pragma once

#include <cmath>

#include "walker/kneed/kneed_advance.h"

namespace walktrack {
inline namespace walker {

// s, by hand; a walker that needs smaller steps is reported as diverged
inline constexpr double kMinStep = 1e-7;
inline constexpr double kMaxRate = 1e3;           // rad/s; ten times the rate of a sprinter's shank
inline constexpr int kMaxStopEvents = 64;         // in one call, by hand; a step has about four
inline constexpr double kTimeTolerance = 1e-13;   // s, of a located event
inline constexpr double kGuardTolerance = 1e-13;  // rad, m or N m: rounding error of a guard
// Factor of kneed_step_size(): RK4 is stable up to 2.8 of its bound; 0.5 keeps its error per radian
// of oscillation below 1e-3.
inline constexpr double kStepReach = 0.5;
// Flexion below which a knee is at its stop, rad, and flexion rate below which it is at rest there,
// rad/s: far above rounding, far below anything visible.
inline constexpr double kAtStop = 1e-9;
inline constexpr double kAtRest = 1e-9;

// Guards are positive between events (including a held stop's torque); an event is a sign change to
// negative.
enum class KneedGuard { kStanceKnee, kSwingKnee, kFootHeight, kFootBehind };

enum class IncidentKind { kStop, kStrike, kStumble };

struct Incident {
  double time = 0;  // s, since the begin of the sub-step
  IncidentKind kind = IncidentKind::kStop;
};

// Finds the root of a guard that is positive before and not positive at the end: the Illinois
// variant of regula falsi (the end of a bracket that is kept twice gets half its weight), with
// bisection while the guard has not risen from zero.
class FallSearch {
 public:
  FallSearch() = default;
  FallSearch(double begin, double at_begin, double end, double at_end)
      : low_(begin), high_(end), at_low_(at_begin), at_high_(at_end), root_(end) {
    finish_or_propose();
  }
  bool done() const { return done_; }
  double trial() const { return trial_; }  // the time of the next evaluation
  double root() const { return root_; }    // when done

  void take(double value) {  // value of the guard at trial()
    if (secant_ && std::abs(value) <= kGuardTolerance) {
      root_ = trial_;
      done_ = true;
      return;
    }
    if (value > 0) {
      low_ = trial_;
      at_low_ = value;
      low_stays_ = 0;
      if (++high_stays_ > 1) at_high_ *= 0.5;
    } else {
      high_ = trial_;
      at_high_ = value;
      high_stays_ = 0;
      if (++low_stays_ > 1) at_low_ *= 0.5;
    }
    finish_or_propose();
  }

 private:
  void finish_or_propose() {
    constexpr int kMaxTrials = 60;  // bisections alone reach the time tolerance in 40
    root_ = high_;
    done_ = trials_++ == kMaxTrials || !(high_ - low_ > kTimeTolerance);
    secant_ = at_low_ > kGuardTolerance;
    trial_ =
        secant_ ? high_ - at_high_ * (high_ - low_) / (at_high_ - at_low_) : 0.5 * (low_ + high_);
  }

  double low_ = 0, high_ = 0, at_low_ = 0, at_high_ = 0, trial_ = 0, root_ = 0;
  int low_stays_ = 0, high_stays_ = 0, trials_ = 0;
  bool secant_ = false, done_ = true;
};

// Applies the support transfer of a strike to `state`, and writes it to `result`.
void transfer_support(const KneedModel& model, const KneedControls& controls, const Vector5& noise,
                      KneedState& state, KneedAdvance& result);

}  // namespace walker
}  // namespace walktrack
