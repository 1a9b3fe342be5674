// The relative pose of two cameras by bundle adjustment over one subject's keypoints (two_views.h):
// every point is at the nearest points of its two rays, and bones have constant length.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/dense.h"
#include "observation/two_views/two_views.h"

namespace walktrack {
inline namespace observation {

inline constexpr size_t kSharedPoints = 17;  // those of COCO

// The joints at one moment, in the first camera's axes; the cameras are at a distance of 1.
using BodyPoints = std::array<Eigen::Vector3d, kSharedPoints>;

inline const Eigen::Vector3d& point_of(const BodyPoints& body, KeypointName name) {
  return body[static_cast<size_t>(name)];
}

// A person at one moment as both cameras see them.
struct SharedMoment {
  double time;
  size_t second;  // moment of the second video that is nearest without a lag
  std::array<Eigen::Vector2d, kSharedPoints> first;
  std::array<bool, kSharedPoints> seen;  // by both cameras
  std::array<double, 2> size_px;         // of the person in each image
};

std::vector<SharedMoment> shared_moments(std::span<const SeenMoment> first,
                                         std::span<const SeenMoment> second);

// A subset, evenly spread.
std::vector<SharedMoment> thinned(const std::vector<SharedMoment>& moments, size_t most);

// The relative pose of the cameras, whose distance is 1.
struct CameraPair {
  std::array<double, 2> focal_px;
  Eigen::Matrix3d second_from_first;
  Eigen::Vector3d translation;
  double lag;  // s
};

// All observations of both cameras. The arguments have to outlive it.
class WalkerRays {
 public:
  // `moments`: at least one.
  WalkerRays(std::vector<SharedMoment> moments, std::span<const SeenMoment> second,
             const TwoViewAssumptions& given);

  // The unknowns of two level cameras rotated relative to each other by `turn` (rad): the distance
  // of the person from each follows from their size, at the mean of their positions.
  Eigen::VectorXd start(double turn) const;
  // The unknowns near `start` at which rays meet best.
  LeastSquaresFit adjusted(const Eigen::VectorXd& start) const;

  CameraPair pair(const Eigen::VectorXd& unknowns) const;
  std::vector<BodyPoints> bodies(const CameraPair& pair) const;
  // Share of the points that are in front of both cameras.
  double ahead(const CameraPair& pair) const;
  // Rms of the points' residuals in the images, share of the person's height; residuals of more
  // than ten standard deviations count as ten.
  double rms(const CameraPair& pair) const;

  // Weight of each moment, because moments at nearly the same time are not independent.
  double weight() const { return weight_; }

 private:
  struct Meeting;
  Eigen::VectorXd residuals(const Eigen::VectorXd& unknowns) const;
  void add_point(size_t point, const CameraPair& pair, Eigen::VectorXd& out,
                 Eigen::Index& at) const;
  Eigen::Vector2d second_at(const SharedMoment& moment, size_t point, double lag) const;
  Meeting meeting(const SharedMoment& moment, size_t point, const CameraPair& pair) const;
  double miss(const SharedMoment& moment, size_t point, const CameraPair& pair) const;
  std::vector<double> bone_misses(const std::vector<BodyPoints>& bodies, KeypointName from,
                                  KeypointName to) const;
  Eigen::Vector3d mean_place(size_t camera) const;

  std::vector<SharedMoment> moments_;
  std::span<const SeenMoment> second_;
  const TwoViewAssumptions& given_;
  double weight_;
};

}  // namespace observation
}  // namespace walktrack
