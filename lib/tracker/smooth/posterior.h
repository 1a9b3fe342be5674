// The reported values of a frame from draws of its trajectory (trajectory.h): pose and joints,
// their bands, and samples, from which the bands of gait and forces come.
//
// The distribution of a joint or an angle is normal: about the reported value, with the variance
// of the draws, which is the uncertainty after images, walker and ground, plus that of the model's
// error (model_error.h). If left and right are swapped with some probability, the distribution is a
// mixture of two: that of this leg and that of the other one. A sample is a draw of the trajectory
// with a draw of the model's error; its legs are swapped with that probability.
//
// Metres, radians, world axes.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "camera/camera.h"
#include "tracker/smooth/model_error.h"
#include "tracker/smooth/trajectory.h"

namespace walktrack {
inline namespace tracker {

// Draws from which variances are taken; their standard deviations are known to 5 %.
inline constexpr size_t kBandDraws = 200;

// The scene of a track, as far as its bands depend on it.
struct BandScene {
  std::vector<Camera> cameras;
  double model_error = 1;  // factor on the model's error
  uint64_t seed = 0;
};

class Posterior {
 public:
  Posterior(const BodyModel& model, BandScene scene, size_t samples);

  size_t draws() const { return std::max(kBandDraws, errors_.size()); }

  // Makes `pose` what is reported of the frame. `draws`: the frame's pose in every draw; `velocity`
  // of the root over the ground, m/s. Frames are reported in their order, `dt` s apart.
  void report(const Pose& pose, std::span<const Pose> draws, double velocity, double dt,
              FrameRecord& record);

 private:
  void report_samples(std::span<const JointPositions> draws, double swapped, double dt,
                      FrameRecord& record);

  BodyModel model_;
  BandScene scene_;
  std::vector<ModelErrorDraw> errors_;  // by sample
};

struct Normal {
  double mean = 0, sd = 0;
};
// The value below which a share `quantile` of the mixture of two normal distributions lies, of
// which the second has the weight `share`.
double mixture_quantile(const Normal& one, const Normal& other, double share, double quantile);

}  // namespace tracker
}  // namespace walktrack
