#include "tracker/others/moving_person.h"

#include <Eigen/LU>

namespace walktrack {
inline namespace tracker {

namespace {

using Eigen::Matrix2d;
using Eigen::Matrix4d;
using Eigen::Vector2d;

// The variance of the velocity grows by so much in a second, m^2/s^3. By hand.
constexpr double kUnrest = 0.25;

constexpr double kFastest = 2.5;  // m/s

}  // namespace

MovingPerson moving_person(const Vector2d& position, const Matrix2d& position_covariance,
                           const Vector2d& velocity, double velocity_sd) {
  MovingPerson out;
  out.mean << position, velocity;
  out.covariance.topLeftCorner<2, 2>() = position_covariance;
  out.covariance.bottomRightCorner<2, 2>() = velocity_sd * velocity_sd * Matrix2d::Identity();
  return out;
}

MovingPerson predicted(const MovingPerson& person, double seconds) {
  const double t = seconds;
  const Matrix2d one = Matrix2d::Identity();
  Matrix4d transition = Matrix4d::Identity(), noise;
  transition.topRightCorner<2, 2>() = t * one;
  noise << t * t * t / 3 * one, t * t / 2 * one, t * t / 2 * one, t * one;
  return {transition * person.mean,
          transition * person.covariance * transition.transpose() + kUnrest * noise};
}

MovingPerson found_at(const MovingPerson& person, const Vector2d& place,
                      const Matrix2d& information) {
  const Matrix2d before = person.position_covariance(), inverse = before.inverse();
  const Matrix2d after = (inverse + information).inverse();
  const Eigen::Matrix<double, 4, 2> gain = person.covariance.leftCols<2>() * inverse;
  MovingPerson out{person.mean + gain * (place - person.position()),
                   person.covariance - gain * (before - after) * gain.transpose()};
  const double speed = out.velocity().norm();
  if (speed > kFastest) out.mean.tail<2>() *= kFastest / speed;
  return out;
}

MovingPerson measured_at(const MovingPerson& person, const Vector2d& place, double sd) {
  const Matrix2d information = Matrix2d::Identity() / (sd * sd);
  const Matrix2d inverse = person.position_covariance().inverse();
  const Vector2d most_probable =
      (inverse + information).inverse() * (inverse * person.position() + information * place);
  return found_at(person, most_probable, information);
}

}  // namespace tracker
}  // namespace walktrack
