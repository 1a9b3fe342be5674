#include "metrics/angle_error.h"

#include <cmath>

#include "body/pose_from_joints.h"
#include "core/conventions.h"
#include "metrics/joint_error.h"

namespace walktrack {
inline namespace metrics {

std::array<double, kAngleCount> angles_of(const Pose& pose) {
  std::array<double, kAngleCount> out;
  size_t k = 0;
  for (const PoseNumber& number : kPoseNumbers)
    if (is_compared(number)) out[k++] = number.in(pose);
  return out;
}

std::array<AngleError, kAngleCount> angle_errors(const Motion& truth, const Motion& estimate) {
  const Motion found = at_times_of(truth, estimate);
  const BodyLengths lengths = body_lengths(Subject{});
  std::array<AngleError, kAngleCount> out;
  for (size_t i = 0; i < truth.time.size(); ++i) {
    const auto a = pose_from_joints(truth.joints[i], lengths);
    const auto b = pose_from_joints(found.joints[i], lengths);
    if (!a || !b) continue;
    const auto expected = angles_of(*a), got = angles_of(*b);
    for (size_t k = 0; k < kAngleCount; ++k) {
      const double error = std::remainder(got[k] - expected[k], 2 * kPi);
      ++out[k].count;
      out[k].mean_absolute += std::abs(error);
      out[k].rms += error * error;
      out[k].bias += error;
    }
  }
  for (AngleError& angle : out) {
    if (angle.count == 0) continue;
    const double n = static_cast<double>(angle.count);
    angle.mean_absolute /= n;
    angle.rms = std::sqrt(angle.rms / n);
    angle.bias /= n;
  }
  return out;
}

}  // namespace metrics
}  // namespace walktrack
