// Errors of the pose angles that follow from true and estimated joint centres
// (body/pose_from_joints.h), both computed with the same standard foot.
#pragma once

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include "body/motion.h"
#include "body/pose_numbers.h"

namespace walktrack {
inline namespace metrics {

// Numbers of trunk and legs; arms are rarely measured.
constexpr bool is_compared(const PoseNumber& number) {
  return number.unit == Unit::kRadian && number.limb() != Limb::kArm;
}
inline constexpr size_t kAngleCount =
    std::count_if(kPoseNumbers.begin(), kPoseNumbers.end(), is_compared);
inline constexpr std::array<std::string_view, kAngleCount> kAngleNames = [] {
  std::array<std::string_view, kAngleCount> names;
  size_t k = 0;
  for (const PoseNumber& number : kPoseNumbers)
    if (is_compared(number)) names[k++] = number.name;
  return names;
}();

// The angles of a pose in the order of kAngleNames, rad.
std::array<double, kAngleCount> angles_of(const Pose& pose);

struct AngleError {
  size_t count = 0;  // frames in which both are known
  double mean_absolute = 0, rms = 0;
  double bias = 0;  // mean of estimate minus truth; sources define the toe differently, so that a
                    // bias of the ankle is not an error
};

// By kAngleNames, rad. Frames with unknown joints are not counted.
std::array<AngleError, kAngleCount> angle_errors(const Motion& truth, const Motion& estimate);

}  // namespace metrics
}  // namespace walktrack
