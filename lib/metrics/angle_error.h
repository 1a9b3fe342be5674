// Errors of the pose angles that follow from true and estimated joint centres
// (body/pose_from_joints.h), both read with the same standard foot.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "body/motion.h"

namespace walktrack {

inline constexpr int kAngleCount = 13;
inline constexpr std::array<std::string_view, kAngleCount> kAngleNames{"heading",
                                                                       "list",
                                                                       "tilt",
                                                                       "lhip_flexion",
                                                                       "lhip_abduction",
                                                                       "lhip_rotation",
                                                                       "lknee_flexion",
                                                                       "lankle_dorsiflexion",
                                                                       "rhip_flexion",
                                                                       "rhip_abduction",
                                                                       "rhip_rotation",
                                                                       "rknee_flexion",
                                                                       "rankle_dorsiflexion"};

// The angles of a pose in the order of kAngleNames, rad.
std::array<double, kAngleCount> angles_of(const Pose& pose);

struct AngleError {
  size_t count = 0;  // frames in which both are known
  double mean_absolute = 0, rms = 0;
  double bias = 0;  // mean of estimate minus truth; sources put the toe at different points, so the
                    // ankle has one that is no error
};

// By kAngleNames, rad. Frames with unknown joints do not count.
std::array<AngleError, kAngleCount> angle_errors(const Motion& truth, const Motion& estimate);

}  // namespace walktrack
