// The information that the images of one frame have about the pose, as a normal distribution near
// the most probable pose (tracker/smooth/refinement.h). The trajectory of the whole video is
// estimated from it (tracker/smooth/trajectory.h).
#pragma once

#include <vector>

#include <Eigen/Core>

#include "tracker/state/free_numbers.h"

namespace walktrack {
inline namespace tracker {

struct ImageInformation {
  Pose walker;  // the particles' mean, which is the walker's prior
  // The most probable pose of the frame. There the gradient of the images' log-likelihood and that
  // of the walker's prior cancel: it is (pose - walker) / spread^2 for every free number.
  Pose pose;
  // Minus the second derivatives of that log-likelihood, without its convex part, over all of
  // kPoseNumbers, zero for those that are not free: the lower triangle, row by row. Empty if the
  // frame's images were not evaluated or give no evidence.
  std::vector<double> information;
};

// `information`: by free number and free number.
std::vector<double> packed(const FreeNumbers& free, const Eigen::MatrixXd& information);
// Its inverse.
Eigen::MatrixXd unpacked(const FreeNumbers& free, const ImageInformation& images);

// Adds other evidence about the pose: a normal distribution about `pose` with that information.
void add_information(const FreeNumbers& free, const Pose& pose, const Eigen::MatrixXd& information,
                     ImageInformation& images);

// The same of the pose with its legs swapped (tracker/moves/mirror_legs.h); the poses are mirrored
// already.
void mirror_information(ImageInformation& images);

}  // namespace tracker
}  // namespace walktrack
