#include "gait/feedback.h"

#include <Eigen/Cholesky>

namespace walktrack {

FeedbackGain feedback_gain(const CycleJacobian& jacobian, double effort) {
  constexpr int kMaxIterations = 500;
  constexpr double kSettled = 1e-10;
  using Outputs = Eigen::Matrix<double, 2, kSectionSize>;
  using Effects = Eigen::Matrix<double, 2, kControlSize>;
  using ControlMatrix = Eigen::Matrix<double, kControlSize, kControlSize>;
  const SectionMatrix a = step_matrix(jacobian);
  const auto b = jacobian.block<kSectionSize, kControlSize>(0, 0).eval();
  const Outputs c = jacobian.block<2, kSectionSize>(kSectionSize, kControlSize);
  const Effects d = jacobian.block<2, kControlSize>(kSectionSize, 0);

  SectionMatrix value = SectionMatrix::Identity();
  FeedbackGain gain = FeedbackGain::Zero();
  for (int i = 0; i < kMaxIterations; ++i) {
    const ControlMatrix weight =
        effort * ControlMatrix::Identity() + d.transpose() * d + b.transpose() * value * b;
    gain = weight.ldlt().solve(b.transpose() * value * a + d.transpose() * c);
    const SectionMatrix next = SectionMatrix::Identity() + c.transpose() * c +
                               a.transpose() * value * a - gain.transpose() * weight * gain;
    const double change = (next - value).norm() / next.norm();
    value = 0.5 * (next + next.transpose());
    if (change < kSettled) break;
  }
  return gain;
}

SectionMatrix closed_loop(const CycleJacobian& jacobian, const FeedbackGain& gain) {
  return step_matrix(jacobian) - jacobian.block<kSectionSize, kControlSize>(0, 0) * gain;
}

}  // namespace walktrack
