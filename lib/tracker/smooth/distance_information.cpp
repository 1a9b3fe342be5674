#include "tracker/smooth/distance_information.h"

#include <algorithm>
#include <cmath>

namespace walktrack {
inline namespace tracker {

namespace {

// Chosen on the foreign renders of tracker/reports/reported_pose.md.
constexpr double kPlaceStep = 0.12;  // m, between the places that are compared

}  // namespace

Eigen::MatrixXd with_distance(const Camera& camera, const FreeNumbers& free, const Pose& pose,
                              const PoseLikelihood& log_likelihood, Eigen::MatrixXd information) {
  const Eigen::Vector2d sight = (pose.root - camera_centre(camera)).head<2>().stableNormalized();
  const auto log_likelihood_at = [&](double distance) {
    Pose aside = pose;
    aside.root.head<kOverGround>() += distance * sight;
    return log_likelihood(aside);
  };
  Eigen::VectorXd along = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(free.size()));
  along.head<kOverGround>() = sight;
  const double near_by = along.dot(information * along);
  if (near_by <= 0) return information;

  const double further =
      (2 * log_likelihood_at(0) - log_likelihood_at(kPlaceStep) - log_likelihood_at(-kPlaceStep)) /
      (kPlaceStep * kPlaceStep);
  if (further >= near_by) return information;
  // Scales that direction, so that the couplings to other numbers become less with it.
  const double scale = std::sqrt(std::max(0.0, further) / near_by);
  const Eigen::MatrixXd scaled = Eigen::MatrixXd::Identity(along.size(), along.size()) -
                                 (1 - scale) * along * along.transpose();
  return scaled * information * scaled;
}

}  // namespace tracker
}  // namespace walktrack
