// The error of the model: no pose of the tracker's body is exactly the subject's.
//
// All draws of a trajectory agree on the pose of this body that explains the images best. Clothes,
// proportions and shapes of the subject displace that pose from the truth, which no number of
// particles shows. This error is added here, as independent normal errors: of the figure as a
// whole, and of each joint and angle by itself. A share of every variance lasts for the whole video
// (a thigh is too long, a definition differs), the rest passes, as a process with the correlation
// (1 + r) exp(-r), r = time / kPassingTime (Matern, smoothness 3/2).
//
// The figure as a whole: its upper and lower end k are each displaced by an error e_k of standard
// deviation e = kFigureError in every direction, in the body and thus for all cameras c alike. The
// place that fits both ends best,
//   M^-1 sum over k of M_k e_k,   M_k = sum over c of J_ck' J_ck,   M = sum over k of M_k,
// with J_ck = d pixel / d point of that end, in metres, has the covariance e^2 M^-1 (sum M_k^2)
// M^-1. One camera at distance D knows the distance to about e D / (height / sqrt(2)) and the rest
// to e / sqrt(2): all of it follows from the places of the cameras. With several cameras all
// directions are known to e / sqrt(2). An end that no camera sees any more has a larger error, by a
// share of its way outside of the image that it left last. The sizes were measured on people with
// truth that are no part of any reported figure; tracker/reports/bands.md says how, and what share
// of the truth bands hold.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "camera/camera.h"
#include "core/rng.h"
#include "tracker/smooth/estimate.h"

namespace walktrack {
inline namespace tracker {

// Covariance of the figure's place, m^2, for a person whose ends are at `head` and `feet`.
Eigen::Matrix3d figure_covariance(std::span<const Camera> cameras, const Eigen::Vector3d& head,
                                  const Eigen::Vector3d& feet);
// Its symmetric square root for the figure of `joints`, m.
Eigen::Matrix3d figure_root(std::span<const Camera> cameras, const JointPositions& joints);

// Widens the spreads of joints and angles by `scale` times the sizes measured. Means stay.
void add_model_error(std::span<const Camera> cameras, double scale, FrameEstimate& estimate);

// A draw of the error of every joint over the frames of a video.
class ModelErrorDraw {
 public:
  ModelErrorDraw(uint64_t seed, uint32_t draw);

  // The error of the next frame, `dt` s after the one before, m. `figure`: figure_root().
  JointPositions next(double dt, const Eigen::Matrix3d& figure);

  // A number between 0 and 1: what has a smaller probability happens in this draw.
  double share() const { return share_; }

 private:
  // A number of variance 1 over time.
  struct Process {
    double lasting = 0, passing = 0, rate = 0;
    double value() const;
  };

  Rng rng_;
  double share_;
  bool begun_ = false;
  std::array<Process, 3> figure_;
  std::array<std::array<Process, 3>, kJointCount> joints_;
};

}  // namespace tracker
}  // namespace walktrack
