#include "camera/view_from_walker.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include "core/errors.h"

namespace walktrack {

namespace {

using Eigen::Vector3d;

// height (m), tilt, roll (rad)
using Place = Vector3d;

Camera camera_at(const Place& place, double focal_px, const ViewAssumptions& given) {
  Camera camera;
  camera.width_px = given.width_px;
  camera.height_px = given.height_px;
  camera.focal_px = {focal_px, focal_px};
  camera.centre_px = {0.5 * (given.width_px - 1), 0.5 * (given.height_px - 1)};
  const double c = std::cos(place[1]), s = std::sin(place[1]);
  Eigen::Matrix3d level;
  // clang-format off
  level << 1,  0,  0,
           0, -s, -c,
           0,  c, -s;
  // clang-format on
  camera.rotation = Eigen::AngleAxisd(place[2], Vector3d::UnitZ()).toRotationMatrix() * level;
  camera.translation = -camera.rotation * Vector3d(0, 0, place[0]);
  return camera;
}

// The row of the head of somebody whose feet are there.
std::optional<double> head_row(const Camera& camera, const SeenStature& seen, double stature) {
  const auto foot = ground_point(camera, {seen.u_px, seen.bottom_px});
  if (!foot) return std::nullopt;
  const auto head = project(camera, *foot + Vector3d(0, 0, stature));
  return head ? std::optional(head->y()) : std::nullopt;
}

double size_px(const SeenStature& seen) { return seen.bottom_px - seen.top_px; }

// Misses of the rows and of what was assumed, in standard deviations.
struct Misses {
  Eigen::VectorXd of;
  bool possible = true;
};

Misses misses(const Place& place, std::span<const SeenStature> positions, double focal_px,
              double stature, const ViewAssumptions& given) {
  const auto n = static_cast<Eigen::Index>(positions.size());
  Misses out{Eigen::VectorXd(n + 2)};
  const Camera camera = camera_at(place, focal_px, given);
  for (Eigen::Index i = 0; i < n; ++i) {
    const SeenStature& seen = positions[static_cast<size_t>(i)];
    const auto row = head_row(camera, seen, stature);
    if (!row || place[0] <= 0) return {{}, false};
    out.of[i] = (seen.top_px - *row) / (given.row_sd * size_px(seen));
  }
  out.of[n] = (place[1] - given.tilt) / given.tilt_sd;
  out.of[n + 1] = place[2] / given.roll_sd;
  return out;
}

struct Fit {
  Place place;
  Eigen::Matrix3d covariance;
  double residual = 0;
};

Eigen::MatrixXd slopes(const Place& place, const auto& missed) {
  constexpr double kStep = 1e-6;
  const Misses here = missed(place);
  Eigen::MatrixXd out(here.of.size(), 3);
  for (int k = 0; k < 3; ++k) {
    Place moved = place;
    moved[k] += kStep;
    const Misses there = missed(moved);
    out.col(k) = there.possible ? Eigen::VectorXd((there.of - here.of) / kStep)
                                : Eigen::VectorXd::Zero(here.of.size());
  }
  return out;
}

// Levenberg-Marquardt from a level camera.
std::optional<Fit> fit(std::span<const SeenStature> positions, double focal_px, double stature,
                       const ViewAssumptions& given) {
  const auto missed = [&](const Place& place) {
    return misses(place, positions, focal_px, stature, given);
  };
  const SeenStature& middle = positions[positions.size() / 2];
  const double horizon = 0.5 * (given.height_px - 1) - focal_px * std::tan(given.tilt);
  Place place(stature * std::max(0.05, (middle.bottom_px - horizon) / size_px(middle)), given.tilt,
              0);
  // Feet above the assumed horizon: the camera looks further down than was thought.
  for (double down = 0; !missed(place).possible && down < 3; down += 0.5)
    place[1] = given.tilt + down * given.tilt_sd;
  if (!missed(place).possible) return std::nullopt;
  double damping = 1e-3;
  for (int iteration = 0; iteration < 100; ++iteration) {
    const Misses here = missed(place);
    const Eigen::MatrixXd slope = slopes(place, missed);
    const Eigen::Matrix3d normal = slope.transpose() * slope;
    Eigen::Matrix3d damped = normal;
    damped.diagonal() *= 1 + damping;
    const Place step = -damped.ldlt().solve(slope.transpose() * here.of);
    const Misses there = missed(place + step);
    if (there.possible && there.of.squaredNorm() <= here.of.squaredNorm()) {
      place += step;
      damping = std::max(damping / 4, 1e-12);
      if (step.norm() < 1e-10) break;
    } else if ((damping *= 8) > 1e9) {
      break;
    }
  }
  const Eigen::MatrixXd slope = slopes(place, missed);
  const Misses last = missed(place);
  const auto n = static_cast<Eigen::Index>(positions.size());
  return Fit{place, (slope.transpose() * slope).inverse(),
             given.row_sd * std::sqrt(last.of.head(n).squaredNorm() / static_cast<double>(n))};
}

// height, tilt, roll, distance, metres per pixel
using Numbers = Eigen::Matrix<double, 5, 1>;

Numbers numbers_of(const Place& place, double focal_px, const SeenStature& middle,
                   const ViewAssumptions& given) {
  const Camera camera = camera_at(place, focal_px, given);
  const Vector3d foot =
      ground_point(camera, {middle.u_px, middle.bottom_px}).value_or(Vector3d::Zero());
  Numbers out;
  out << place, foot.head<2>().norm(), camera_point(camera, foot).z() / focal_px;
  return out;
}

Measured measured(const Numbers& values, const Numbers& variances, int k) {
  return {values[k], std::sqrt(variances[k])};
}

}  // namespace

WalkerView view_from_walker(std::span<const SeenStature> positions, const ViewAssumptions& given) {
  const SeenStature& middle = positions[positions.size() / 2];
  const auto best = fit(positions, given.focal_px, given.stature, given);
  if (!best)
    throw InputError(fmt::format(
        "the feet in row {:.0f} are above the horizon of a camera that is nearly level (row "
        "{:.0f}); "
        "state how far it looks down (negative: up) with --tilt-deg",
        middle.bottom_px, 0.5 * (given.height_px - 1) - given.focal_px * std::tan(given.tilt)));
  const Numbers values = numbers_of(best->place, given.focal_px, middle, given);
  Numbers variances = Numbers::Zero();
  // What the rows leave open, along the axes of its covariance, and what was assumed.
  const auto add = [&](const Place& place, double focal_px) {
    variances += (numbers_of(place, focal_px, middle, given) - values).cwiseAbs2();
  };
  const Eigen::Matrix3d root = best->covariance.llt().matrixL();
  for (int k = 0; k < 3; ++k) add(best->place + 0.1 * root.col(k), given.focal_px);
  variances *= 100;  // of a tenth of it, for which all is linear
  if (const auto other = fit(positions, given.focal_px + given.focal_sd, given.stature, given))
    add(other->place, given.focal_px + given.focal_sd);
  if (const auto other = fit(positions, given.focal_px, given.stature + given.stature_sd, given))
    add(other->place, given.focal_px);
  WalkerView out;
  out.camera = camera_at(best->place, given.focal_px, given);
  const auto foot = ground_point(out.camera, {middle.u_px, middle.bottom_px});
  out.camera.translation += out.camera.rotation * Vector3d(foot->x(), foot->y(), 0);
  out.height = measured(values, variances, 0);
  out.tilt = measured(values, variances, 1);
  out.roll = measured(values, variances, 2);
  out.distance = measured(values, variances, 3);
  out.metres_per_px = measured(values, variances, 4);
  out.residual = best->residual;
  return out;
}

}  // namespace walktrack
