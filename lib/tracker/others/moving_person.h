// Somebody's place and velocity over the ground with their uncertainty: a Kalman filter with nearly
// constant velocity (Bar-Shalom, Li & Kirubarajan 2001, Estimation with Applications to Tracking
// and Navigation, 6.2.2).
#pragma once

#include <Eigen/Core>

namespace walktrack {
inline namespace tracker {

struct MovingPerson {
  Eigen::Vector4d mean = Eigen::Vector4d::Zero();        // x, y, m; their velocities, m/s
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();  // of the same

  Eigen::Vector2d position() const { return mean.head<2>(); }
  Eigen::Vector2d velocity() const { return mean.tail<2>(); }
  Eigen::Matrix2d position_covariance() const { return covariance.topLeftCorner<2, 2>(); }
};

// `position_covariance` in m^2, `velocity_sd` in m/s.
MovingPerson moving_person(const Eigen::Vector2d& position,
                           const Eigen::Matrix2d& position_covariance,
                           const Eigen::Vector2d& velocity, double velocity_sd);

// So many seconds later.
MovingPerson predicted(const MovingPerson& person, double seconds);

// After they were found at `place`, the most probable one by the prediction and by what was seen
// together, which has that information (inverse covariance) about the place, m^-2.
MovingPerson found_at(const MovingPerson& person, const Eigen::Vector2d& place,
                      const Eigen::Matrix2d& information);

// After a measurement of the place with that standard deviation, m.
MovingPerson measured_at(const MovingPerson& person, const Eigen::Vector2d& place, double sd);

}  // namespace tracker
}  // namespace walktrack
