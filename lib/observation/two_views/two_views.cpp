#include "observation/two_views/two_views.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "core/conventions.h"
#include "core/dense.h"
#include "core/errors.h"
#include "observation/two_views/walker_floor.h"
#include "observation/two_views/walker_rays.h"

namespace walktrack {
inline namespace observation {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

// Moments that both cameras see: fewer are not enough, more do not improve the result. By hand.
constexpr size_t kLeastMoments = 20, kMostMoments = 120, kCoarseMoments = 24;
constexpr int kTurns = 18;            // relative rotations of the cameras that are tried
constexpr double kMostlyAhead = 0.9;  // share of the points; by hand
// Residuals of points, if their errors are as assumed (walker_rays.cpp): the rays leave one
// direction of two undetermined. Larger residuals increase the uncertainty (the variance of unit
// weight).
constexpr double kExpectedRms = 0.007;
// Limbs seem to swing earlier or later by so much from different sides, s: found on a rendered walk
// (1 frame of 30 Hz) and on two telephones (1 of 60 Hz) without a lag.
constexpr double kLagOfSidesSd = 0.02;

// The best of many rotations, on few of the moments.
std::optional<VectorXd> coarse(const std::vector<SharedMoment>& moments,
                               std::span<const SeenMoment> second,
                               const TwoViewAssumptions& given) {
  const WalkerRays rays(thinned(moments, kCoarseMoments), second, given);
  std::optional<VectorXd> best;
  double least = 0;
  for (int k = 0; k < kTurns; ++k) {
    const LeastSquaresFit found = rays.adjusted(rays.start(kPi * ((2 * k + 1.0) / kTurns - 1)));
    const double cost = found.residuals.squaredNorm();
    if (rays.ahead(rays.pair(found.x)) < kMostlyAhead || (best && cost >= least)) continue;
    best = found.x;
    least = cost;
  }
  return best;
}

// The cameras in the world.
struct Placed {
  std::array<Camera, 2> cameras;
  std::vector<Vector3d> places;
};

Camera camera_of(const LensAssumption& lens, double focal_px, const Matrix3d& rotation,
                 const Vector3d& translation) {
  Camera camera;
  camera.width_px = lens.width_px;
  camera.height_px = lens.height_px;
  camera.focal_px.setConstant(focal_px);
  camera.centre_px = {0.5 * (lens.width_px - 1), 0.5 * (lens.height_px - 1)};
  camera.rotation = rotation;
  camera.translation = translation;
  return camera;
}

Matrix3d world_from_first(const Vector3d& up) {
  Matrix3d out;
  out.row(2) = up;
  out.row(0) = (Vector3d::UnitX() - up.x() * up).normalized();
  out.row(1) = up.cross(Vector3d(out.row(0)));
  return out;
}

Placed placed(const std::vector<BodyPoints>& bodies, const CameraPair& pair,
              const WalkerFloor& floor, const TwoViewAssumptions& given) {
  const Matrix3d world = world_from_first(floor.up), first = world.transpose();
  Placed out;
  Vector3d middle = Vector3d::Zero();
  for (const BodyPoints& body : bodies) {
    out.places.push_back(
        0.5 * floor.scale * world *
        (point_of(body, KeypointName::kLeftHip) + point_of(body, KeypointName::kRightHip)));
    middle += out.places.back() / static_cast<double>(bodies.size());
  }
  middle.z() = floor.height;
  for (Vector3d& place : out.places) place = {place.x() - middle.x(), place.y() - middle.y(), 0};
  const Vector3d origin = first * middle;
  out.cameras = {camera_of(given.lenses[0], pair.focal_px[0], first, origin),
                 camera_of(given.lenses[1], pair.focal_px[1], pair.second_from_first * first,
                           pair.second_from_first * origin + floor.scale * pair.translation)};
  return out;
}

// focal lengths, heights, tilts, distances, apart, angle, lag
using Numbers = Eigen::Matrix<double, 11, 1>;

Numbers numbers_of(const std::array<Camera, 2>& cameras, double lag) {
  Numbers out;
  for (int k = 0; k < 2; ++k) {
    const Camera& camera = cameras[static_cast<size_t>(k)];
    const Vector3d centre = camera_centre(camera);
    out[k] = camera.focal_px.x();
    out[2 + k] = centre.z();
    out[4 + k] = std::asin(std::clamp(-camera.rotation(2, 2), -1.0, 1.0));
    out[6 + k] = centre.head<2>().norm();
  }
  out[8] = (camera_centre(cameras[0]) - camera_centre(cameras[1])).norm();
  out[9] =
      std::acos(std::clamp(cameras[0].rotation.row(2).dot(cameras[1].rotation.row(2)), -1.0, 1.0));
  out[10] = lag;
  return out;
}

// All results as functions of the unknowns of the rays; the floor follows from them.
struct Solution {
  Placed at;
  Numbers numbers;
  Eigen::Matrix2d lean_covariance;
};

Solution solved(const WalkerRays& rays, const VectorXd& unknowns, const TwoViewAssumptions& given,
                double stature, const Vector2d& more_lean = Vector2d::Zero()) {
  const CameraPair pair = rays.pair(unknowns);
  const std::vector<BodyPoints> bodies = rays.bodies(pair);
  const FloorFit fit(bodies, pair, rays.weight(), stature);
  Solution out{placed(bodies, pair, fit.floor(more_lean), given),
               {},
               fit.fit().covariance().topLeftCorner<2, 2>()};
  out.numbers = numbers_of(out.at.cameras, pair.lag);
  return out;
}

// Variances due to what the rays leave undetermined (along the axes of its covariance), the floor
// and the stature.
Numbers variances_of(const WalkerRays& rays, const LeastSquaresFit& found, const Solution& best,
                     const TwoViewAssumptions& given) {
  constexpr double kSmall = 0.1;  // share of a deviation for which functions are nearly linear
  Numbers out = Numbers::Zero();
  const auto add = [&](const Solution& other) {
    out += (other.numbers - best.numbers).cwiseAbs2() / (kSmall * kSmall);
  };
  const double unit = std::max(1.0, rays.rms(rays.pair(found.x)) / kExpectedRms);
  const Eigen::MatrixXd open = unit * cholesky_root(found.covariance());
  for (const auto& axis : open.colwise())
    add(solved(rays, found.x + kSmall * axis, given, given.stature));
  const Eigen::Matrix2d lean = cholesky_root(best.lean_covariance);
  for (const auto& axis : lean.colwise())
    add(solved(rays, found.x, given, given.stature, kSmall * axis));
  const double stature_sd = std::hypot(given.stature_sd, kEyesSd * given.stature);
  add(solved(rays, found.x, given, given.stature + kSmall * stature_sd));
  return out;
}

TwoViews views_of(const Solution& best, const Numbers& variances) {
  const auto measured = [&](int k) { return Measured{best.numbers[k], std::sqrt(variances[k])}; };
  TwoViews out;
  out.cameras = best.at.cameras;
  for (int k = 0; k < 2; ++k) {
    const auto camera = static_cast<size_t>(k);
    out.focal_px[camera] = measured(k);
    out.height[camera] = measured(2 + k);
    out.tilt[camera] = measured(4 + k);
    out.distance[camera] = measured(6 + k);
  }
  out.apart = measured(8);
  out.angle = measured(9);
  out.lag = measured(10);
  out.places = best.at.places;
  return out;
}

}  // namespace

TwoViews two_views(std::span<const SeenMoment> first, std::span<const SeenMoment> second,
                   const TwoViewAssumptions& given) {
  const std::vector<SharedMoment> moments = shared_moments(first, second);
  if (moments.size() < kLeastMoments)
    throw InputError(fmt::format(
        "both cameras see one person at the same time in {} frames, at least {} are needed",
        moments.size(), kLeastMoments));
  const auto start = coarse(moments, second, given);
  if (!start)
    throw InputError("what the two cameras see is not one person, or not at the same time");
  const WalkerRays rays(thinned(moments, kMostMoments), second, given);
  const LeastSquaresFit found = rays.adjusted(*start);
  const Solution best = solved(rays, found.x, given, given.stature);
  TwoViews out = views_of(best, variances_of(rays, found, best, given));
  out.lag.sd = std::hypot(out.lag.sd, kLagOfSidesSd);
  out.residual = rays.rms(rays.pair(found.x));
  return out;
}

}  // namespace observation
}  // namespace walktrack
