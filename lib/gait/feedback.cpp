#include "gait/feedback.h"

#include "core/dense.h"

namespace walktrack {
inline namespace gait {

using Eigen::MatrixXd;

MatrixXd regulator_gain(const LinearStep& step, double effort) {
  // Limits of the iteration of the Riccati equation; by hand.
  constexpr int kMaxIterations = 500;
  constexpr double kSettled = 1e-10;
  const auto& [a, b, c, d] = step;
  const MatrixXd unit = MatrixXd::Identity(a.rows(), a.rows());
  const MatrixXd price = effort * MatrixXd::Identity(b.cols(), b.cols()) + d.transpose() * d;
  MatrixXd value = unit, gain = MatrixXd::Zero(b.cols(), a.rows());
  for (int i = 0; i < kMaxIterations; ++i) {
    const MatrixXd weight = price + b.transpose() * value * b;
    gain = solve_positive(weight, b.transpose() * value * a + d.transpose() * c);
    const MatrixXd next =
        unit + c.transpose() * c + a.transpose() * value * a - gain.transpose() * weight * gain;
    const double change = (next - value).norm() / next.norm();
    value = 0.5 * (next + next.transpose());
    if (change < kSettled) break;
  }
  return gain;
}

FeedbackGain feedback_gain(const CycleJacobian& jacobian, double effort) {
  return regulator_gain({step_matrix(jacobian), jacobian.block<kSectionSize, kControlSize>(0, 0),
                         jacobian.block<2, kSectionSize>(kSectionSize, kControlSize),
                         jacobian.block<2, kControlSize>(kSectionSize, 0)},
                        effort);
}

}  // namespace gait
}  // namespace walktrack
