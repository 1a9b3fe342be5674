// A stabilising feedback at support transfer: the next step's controls from the state after the
// strike. It is the stationary linear-quadratic regulator of the step map linearised at a cycle,
//   end' = A section' + B controls',   (advance, period)' = C section' + D controls',
// that minimises the sum over steps of |end'|^2 + |(advance, period)'|^2 + effort |controls'|^2,
// all in units L = M = g = 1 and in the control vector's square roots.
#pragma once

#include "gait/cycle.h"

namespace walktrack {
inline namespace gait {

using FeedbackGain = Eigen::Matrix<double, kControlSize, kSectionSize>;

struct LinearStep {
  Eigen::MatrixXd a, b;  // of the section's end
  Eigen::MatrixXd c, d;  // of advance and period
};

// controls' = -gain * section'. Iterates the Riccati difference equation to its fixed point; the
// step map of a cycle can be stabilised whenever a step can be changed at all.
Eigen::MatrixXd regulator_gain(const LinearStep& step, double effort);
FeedbackGain feedback_gain(const CycleJacobian& jacobian, double effort);

}  // namespace gait
}  // namespace walktrack
