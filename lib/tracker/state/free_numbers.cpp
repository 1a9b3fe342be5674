#include "tracker/state/free_numbers.h"

#include <algorithm>

namespace walktrack {
inline namespace tracker {

namespace {

using Eigen::VectorXd;

const PoseNumber& number_at(const FreeNumbers& free, Eigen::Index k) {
  return kPoseNumbers[free[static_cast<size_t>(k)]];
}

template <typename Of>
VectorXd each(const FreeNumbers& free, const Of& of) {
  VectorXd out(static_cast<Eigen::Index>(free.size()));
  for (Eigen::Index k = 0; k < out.size(); ++k) out[k] = of(number_at(free, k));
  return out;
}

}  // namespace

FreeNumbers free_numbers(const BodyModel& model) {
  FreeNumbers out;
  for (size_t i = 0; i < kPoseNumbers.size(); ++i) {
    const PoseNumber& number = kPoseNumbers[i];
    if (number.sideways && !turns(model)) continue;
    if (number.limb() == Limb::kArm && !model.body.groups.arms) continue;
    out.push_back(i);
  }
  return out;
}

VectorXd values_of(const FreeNumbers& free, const Pose& pose) {
  return each(free, [&](const PoseNumber& number) { return number.in(pose); });
}

Pose with_values(const FreeNumbers& free, Pose pose, const VectorXd& values) {
  for (Eigen::Index k = 0; k < values.size(); ++k) {
    const PoseNumber& number = number_at(free, k);
    number.in(pose) = std::max(number.lowest, values[k]);
  }
  return pose;
}

VectorXd difference(const FreeNumbers& free, const Pose& from, const Pose& to) {
  return each(free, [&](const PoseNumber& number) {
    return number.difference(number.in(from), number.in(to));
  });
}

VectorXd spreads_of(const FreeNumbers& free) {
  return each(free, [](const PoseNumber& number) { return number.spread; });
}

}  // namespace tracker
}  // namespace walktrack
