#include "tracker/smooth/smoother.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Cholesky>

#include "body/pose_numbers.h"

namespace walktrack {
inline namespace tracker {

namespace {

// Standard deviations of the weighting within the lag: beyond, a frame counts for nothing.
// So the lag is defined.
constexpr double kWithinLag = 3;
constexpr double kLeastVariance = 1e-12;  // m^2: particles may agree

double variance_of(const FrameEstimate& estimate) {
  double sum = 0;
  for (size_t j = 0; j < estimate.joint_count; ++j)
    for (const Spread& axis : estimate.spread[j]) sum += axis.sd * axis.sd;
  return std::max(kLeastVariance, sum / (3 * static_cast<double>(estimate.joint_count)));
}

// Adds `weight` times the difference of two frames to `sum`.
void add(double weight, const Pose& pose, const Pose& middle, Pose& sum) {
  for (const PoseNumber& number : kPoseNumbers)
    number.in(sum) += weight * number.difference(number.in(middle), number.in(pose));
}

void add(double weight, const FrameRecord& each, const FrameRecord& middle, FrameRecord& sum) {
  FrameEstimate& estimate = sum.estimate;
  const auto joints = [&](const JointPositions& x, const JointPositions& y, JointPositions& to) {
    for (size_t j = 0; j < estimate.joint_count; ++j) to.at[j] += weight * (x.at[j] - y.at[j]);
  };
  estimate.speed += weight * (each.estimate.speed - middle.estimate.speed);
  add(weight, each.estimate.pose, middle.estimate.pose, estimate.pose);
  joints(each.estimate.joints, middle.estimate.joints, estimate.joints);
  for (size_t m = 0; m < sum.samples.size(); ++m)
    joints(each.samples.at(m), middle.samples[m], sum.samples[m]);
}

}  // namespace

std::vector<double> smoothing_weights(std::span<const double> times,
                                      std::span<const double> variances, double lag) {
  const Eigen::Index terms = std::min<Eigen::Index>(3, static_cast<Eigen::Index>(times.size()));
  Eigen::MatrixXd powers(terms, static_cast<Eigen::Index>(times.size()));
  Eigen::VectorXd w(powers.cols());
  for (Eigen::Index i = 0; i < powers.cols(); ++i) {
    const double t = times[static_cast<size_t>(i)] / lag;
    for (Eigen::Index k = 0; k < terms; ++k) powers(k, i) = std::pow(t, k);
    w[i] = std::exp(-0.5 * kWithinLag * kWithinLag * t * t) / variances[static_cast<size_t>(i)];
  }
  w /= w.maxCoeff();
  const Eigen::MatrixXd normal = powers * w.asDiagonal() * powers.transpose();
  const Eigen::VectorXd value = Eigen::VectorXd::Unit(terms, 0);
  const Eigen::VectorXd solved = w.asDiagonal() * powers.transpose() * normal.ldlt().solve(value);
  return {solved.begin(), solved.end()};
}

Smoother::Smoother(const SmoothingConfig& config, double dt)
    // A frame at the lag itself would count, but for rounding.
    : lag_(config.lag), dt_(dt), reach_(static_cast<size_t>(std::floor(config.lag / dt + 1e-9))) {}

std::vector<FrameRecord> Smoother::push(FrameRecord record) {
  window_.push_back(std::move(record));
  ++waiting_;
  std::vector<FrameRecord> out;
  if (waiting_ > reach_) {
    out.push_back(smoothed(window_.size() - waiting_));
    --waiting_;
  }
  while (window_.size() > waiting_ + reach_) window_.pop_front();
  return out;
}

std::vector<FrameRecord> Smoother::finish() {
  std::vector<FrameRecord> out;
  for (; waiting_ > 0; --waiting_) out.push_back(smoothed(window_.size() - waiting_));
  window_.clear();
  return out;
}

FrameRecord Smoother::smoothed(size_t at) const {
  FrameRecord out = window_[at];
  if (!out.tracked) return out;
  size_t first = at, last = at;
  while (first > 0 && at - first < reach_ && window_[first - 1].tracked) --first;
  while (last + 1 < window_.size() && last - at < reach_ && window_[last + 1].tracked) ++last;
  std::vector<double> times, variances;
  for (size_t i = first; i <= last; ++i) {
    times.push_back((static_cast<double>(i) - static_cast<double>(at)) * dt_);
    variances.push_back(variance_of(window_[i].estimate));
  }
  const std::vector<double> weights = smoothing_weights(times, variances, lag_);
  for (size_t i = first; i <= last; ++i) add(weights[i - first], window_[i], window_[at], out);
  shift_bands(window_[at].estimate, out.estimate);
  return out;
}

}  // namespace tracker
}  // namespace walktrack
