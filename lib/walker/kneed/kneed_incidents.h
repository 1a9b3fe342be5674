// What is said of events once for kneed_advance() and kneed_advance_batch(); internal to
// lib/walker.
#pragma once

#include <cmath>

#include "walker/kneed/kneed_advance.h"

namespace walktrack {
inline namespace walker {

// s, by hand; a walker that needs less is reported as diverged
inline constexpr double kMinStep = 1e-7;
inline constexpr double kMaxRate = 1e3;          // rad/s; ten times what a sprinter's shank reaches
inline constexpr int kMaxStopEvents = 64;        // in one call, by hand; a step has about four
inline constexpr double kTimeTolerance = 1e-13;  // s, of a located event
inline constexpr double kGuardTolerance = 1e-13;  // rad, m or N m: rounding of a guard
// Sub-steps of kneed_step_size(): RK4 is stable to 2.8 of its bound; 0.5 keeps its error per radian
// of oscillation below 1e-3.
inline constexpr double kStepReach = 0.5;
// Flexion below which a knee is at its stop, rad, and flexion rate below which it rests there,
// rad/s: far above rounding, far below what anybody can see.
inline constexpr double kAtStop = 1e-9;
inline constexpr double kAtRest = 1e-9;

// Positive while all is well (a held stop's torque included); an event is the fall through zero.
enum class KneedGuard { kStanceKnee, kSwingKnee, kFootHeight, kFootBehind };

enum class IncidentKind { kStop, kStrike, kStumble };

struct Incident {
  double time = 0;  // s, since the begin of the sub-step
  IncidentKind kind = IncidentKind::kStop;
};

// Where a guard, positive before and not positive at the end, reaches zero: the Illinois variant of
// regula falsi (a bracket's end that stays twice loses half its weight), and bisection while the
// guard still leaves zero itself.
class FallSearch {
 public:
  FallSearch() = default;
  FallSearch(double begin, double at_begin, double end, double at_end)
      : low_(begin), high_(end), at_low_(at_begin), at_high_(at_end), root_(end) {
    finish_or_propose();
  }
  bool done() const { return done_; }
  double trial() const { return trial_; }  // where the guard is wanted next
  double root() const { return root_; }    // when done

  void take(double value) {  // of the guard at trial()
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
    constexpr int kMaxTrials = 60;  // halvings alone reach the time tolerance in 40
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

// The support transfer at a strike, applied to `state` and written to `result`.
void transfer_support(const KneedModel& model, const KneedControls& controls, const Vector5& noise,
                      KneedState& state, KneedAdvance& result);

}  // namespace walker
}  // namespace walktrack
