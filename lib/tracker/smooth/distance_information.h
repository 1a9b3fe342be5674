// What the images of one camera say about the subject's distance.
//
// One frame hardly shows a distance; the trajectory (tracker/smooth/trajectory.h), in which
// neighbouring frames have nearly the same, adds up what all of them show. It moves the subject
// along the line of sight by ten centimetres and more, whereas the images' curvature comes from
// sigma points a centimetre apart (filter/map_estimate.h). Outlines of pixels are rough at that
// scale: along the line of sight the log-likelihood bends three to nineteen times as much there as
// between places twelve centimetres apart, and the trajectory would stay where the particles were.
// tracker/reports/reported_pose.md has measurements.
#pragma once

#include <functional>

#include <Eigen/Core>

#include "camera/camera.h"
#include "tracker/state/free_numbers.h"

namespace walktrack {
inline namespace tracker {

// Of a pose, nats.
using PoseLikelihood = std::function<double(const Pose&)>;

// The information about `pose` (tracker/smooth/image_information.h), by free number, in which the
// curvature along the line of sight over the ground is that between places further apart, if it is
// smaller there. Positive semidefinite as before.
Eigen::MatrixXd with_distance(const Camera& camera, const FreeNumbers& free, const Pose& pose,
                              const PoseLikelihood& log_likelihood, Eigen::MatrixXd information);

}  // namespace tracker
}  // namespace walktrack
