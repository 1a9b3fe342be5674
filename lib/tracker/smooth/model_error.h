// What the particles' spread leaves out: no pose of our body is quite the person's.
//
// Particles agree on the pose of our body that explains the images best. Clothes, proportions and
// the parts' shapes move that best pose off the truth, frame after frame in the same way, and no
// number of particles shows it. It is added here, as independent normal errors: of the figure as a
// whole, and of each joint and angle by itself.
//
// The figure as a whole: its upper and lower end are each seen e = kFigureError wrong in every
// camera, in metres at the person, so that displacing the figure by d costs
//   sum over cameras and ends |J d|^2 / (2 e^2),   J = d pixel / d point, in metres at the person.
// One camera at distance D thus knows the distance to about e D / (height / sqrt(2)) and the rest
// to e / sqrt(2): all comes from where the cameras stand. The sizes were measured on walks with
// truth that are no part of any reported figure; tracker/reports/bands.md says how and what
// coverage they give.
#pragma once

#include <span>

#include "camera/camera.h"
#include "tracker/smooth/estimate.h"

namespace walktrack {
inline namespace tracker {

// Covariance of the figure's place, m^2, for a person whose ends are at `head` and `feet`.
Eigen::Matrix3d figure_covariance(std::span<const Camera> cameras, const Eigen::Vector3d& head,
                                  const Eigen::Vector3d& feet);

// Widens the spreads of joints and angles by `scale` times the sizes measured. Means stay.
void add_model_error(std::span<const Camera> cameras, double scale, FrameEstimate& estimate);

}  // namespace tracker
}  // namespace walktrack
