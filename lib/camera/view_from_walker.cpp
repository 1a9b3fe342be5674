#include "camera/view_from_walker.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "core/dense.h"
#include "core/errors.h"

namespace walktrack {
inline namespace camera {

namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

// height (m), tilt, roll (rad), logarithms of the ratios of focal length and stature to the assumed
// ones
enum Unknown : Eigen::Index { kHeight, kTilt, kRoll, kLogFocal, kLogStature, kUnknowns };
using Place = Eigen::Matrix<double, kUnknowns, 1>;

// Residual of impossible values, in standard deviations.
constexpr double kImpossible = 1e9;
// Smallest relative standard deviation, for values that are stated as certain.
constexpr double kCertain = 1e-6;

double focal_of(const Place& place, const ViewAssumptions& given) {
  return given.focal_px * std::exp(place[kLogFocal]);
}

Camera camera_at(const Place& place, const ViewAssumptions& given) {
  Camera camera;
  camera.width_px = given.width_px;
  camera.height_px = given.height_px;
  camera.focal_px.setConstant(focal_of(place, given));
  camera.centre_px = {0.5 * (given.width_px - 1), 0.5 * (given.height_px - 1)};
  const double c = std::cos(place[kTilt]), s = std::sin(place[kTilt]);
  Eigen::Matrix3d level;
  // clang-format off
  level << 1,  0,  0,
           0, -s, -c,
           0,  c, -s;
  // clang-format on
  camera.rotation = Eigen::AngleAxisd(place[kRoll], Vector3d::UnitZ()).toRotationMatrix() * level;
  camera.translation = -camera.rotation * Vector3d(0, 0, place[kHeight]);
  return camera;
}

// The row of the head of a person whose feet are there.
std::optional<double> head_row(const Camera& camera, const SeenStature& seen, double stature) {
  const auto foot = ground_point(camera, {seen.u_px, seen.bottom_px});
  if (!foot) return std::nullopt;
  const auto head = project(camera, *foot + Vector3d(0, 0, stature));
  return head ? std::optional(head->y()) : std::nullopt;
}

double size_px(const SeenStature& seen) { return seen.bottom_px - seen.top_px; }

// The difference between the computed and the stated length on the floor, m; nullopt above the
// horizon.
std::optional<double> excess(const Camera& camera, const FloorLength& length) {
  const auto from = ground_point(camera, length.from_px), to = ground_point(camera, length.to_px);
  if (!from || !to) return std::nullopt;
  return (*to - *from).norm() - length.metres;
}

// Residuals of rows, lengths and assumptions, in standard deviations.
struct Misses {
  std::span<const SeenStature> positions;
  const ViewAssumptions& given;

  VectorXd at(const Place& place) const {
    const auto rows = static_cast<Eigen::Index>(positions.size()),
               lengths = static_cast<Eigen::Index>(given.floor.size());
    VectorXd out(rows + lengths + 4);
    const double stature = given.stature * std::exp(place[kLogStature]);
    const Camera camera = camera_at(place, given);
    for (Eigen::Index i = 0; i < rows; ++i) {
      const SeenStature& seen = positions[static_cast<size_t>(i)];
      const auto row = place[kHeight] > 0 ? head_row(camera, seen, stature) : std::nullopt;
      out[i] = row ? (seen.top_px - *row) / (given.row_sd * size_px(seen)) : kImpossible;
    }
    for (Eigen::Index i = 0; i < lengths; ++i) {
      const FloorLength& length = given.floor[static_cast<size_t>(i)];
      const auto longer = excess(camera, length);
      // Both points have independent errors along the line between them.
      const double sd = std::numbers::sqrt2 * given.point_sd_px * length.metres /
                        (length.to_px - length.from_px).norm();
      out[rows + i] = longer ? *longer / sd : kImpossible;
    }
    out.tail<4>() << (place[kTilt] - given.tilt) / given.tilt_sd, place[kRoll] / given.roll_sd,
        place[kLogFocal] / std::max(kCertain, given.focal_sd / given.focal_px),
        place[kLogStature] / std::max(kCertain, given.stature_sd / given.stature);
    return out;
  }
  bool possible(const Place& place) const { return at(place).maxCoeff() < kImpossible; }
};

struct Fit {
  Place place;
  Eigen::Matrix<double, kUnknowns, kUnknowns> covariance;
  double residual = 0;
};

// Begins with a level camera.
std::optional<Fit> fit(std::span<const SeenStature> positions, const ViewAssumptions& given) {
  const Misses misses{positions, given};
  const SeenStature& middle = positions[positions.size() / 2];
  const double horizon = 0.5 * (given.height_px - 1) - given.focal_px * std::tan(given.tilt);
  Place place = Place::Zero();
  place[kHeight] = given.stature * std::max(0.05, (middle.bottom_px - horizon) / size_px(middle));
  place[kTilt] = given.tilt;
  // Feet are above the assumed horizon: the camera is tilted further down than assumed.
  for (double down = 0; !misses.possible(place) && down < 3; down += 0.5)
    place[kTilt] = given.tilt + down * given.tilt_sd;
  if (!misses.possible(place)) return std::nullopt;
  const LeastSquaresFit found =
      minimise_squares([&](const VectorXd& x) { return misses.at(x); }, place);
  const auto n = static_cast<Eigen::Index>(positions.size());
  return Fit{
      found.x, found.covariance(),
      given.row_sd * std::sqrt(found.residuals.head(n).squaredNorm() / static_cast<double>(n))};
}

// focal length, height, tilt, roll, distance, metres per pixel
using Numbers = Eigen::Matrix<double, 6, 1>;

Numbers numbers_of(const Place& place, const SeenStature& middle, const ViewAssumptions& given) {
  const Camera camera = camera_at(place, given);
  const Vector3d foot =
      ground_point(camera, {middle.u_px, middle.bottom_px}).value_or(Vector3d::Zero());
  Numbers out;
  out << focal_of(place, given), place.head<3>(), foot.head<2>().norm(),
      camera_point(camera, foot).z() / focal_of(place, given);
  return out;
}

Measured measured(const Numbers& values, const Numbers& variances, int k) {
  return {values[k], std::sqrt(variances[k])};
}

double floor_rms(const Camera& camera, const std::vector<FloorLength>& floor) {
  double sum = 0;
  for (const FloorLength& length : floor) sum += std::pow(excess(camera, length).value_or(0), 2);
  return floor.empty() ? 0 : std::sqrt(sum / static_cast<double>(floor.size()));
}

// Refuses lengths that are not below the horizon of the assumed camera, and cannot be on the floor.
void check_floor(const ViewAssumptions& given) {
  Place place = Place::Zero();
  place[kHeight] = 1;
  place[kTilt] = given.tilt + 3 * given.tilt_sd;
  const Camera camera = camera_at(place, given);
  for (const FloorLength& length : given.floor)
    for (const Eigen::Vector2d& point : {length.from_px, length.to_px})
      if (!ground_point(camera, point))
        throw InputError(
            fmt::format("the floor's point in column {:.0f}, row {:.0f} is above the horizon",
                        point.x(), point.y()));
}

}  // namespace

WalkerView view_from_walker(std::span<const SeenStature> positions, const ViewAssumptions& given) {
  check_floor(given);
  const SeenStature& middle = positions[positions.size() / 2];
  const auto best = fit(positions, given);
  if (!best)
    throw InputError(fmt::format(
        "the feet in row {:.0f} are above the horizon of a camera that is nearly level (row "
        "{:.0f}); "
        "state how far it looks down (negative: up) with --tilt-deg",
        middle.bottom_px, 0.5 * (given.height_px - 1) - given.focal_px * std::tan(given.tilt)));
  const Numbers values = numbers_of(best->place, middle, given);
  Numbers variances = Numbers::Zero();
  // The uncertainty that rows and lengths leave, along the axes of its covariance.
  constexpr double kSmall = 0.1;  // share of a deviation for which functions are nearly linear
  const Eigen::MatrixXd root = cholesky_root(best->covariance);
  for (int k = 0; k < kUnknowns; ++k)
    variances +=
        (numbers_of(best->place + kSmall * root.col(k), middle, given) - values).cwiseAbs2() /
        (kSmall * kSmall);
  WalkerView out;
  out.camera = camera_at(best->place, given);
  const auto foot = ground_point(out.camera, {middle.u_px, middle.bottom_px});
  out.floor_rms = floor_rms(out.camera, given.floor);
  out.camera.translation += out.camera.rotation * Vector3d(foot->x(), foot->y(), 0);
  out.focal_px = measured(values, variances, 0);
  out.height = measured(values, variances, 1);
  out.tilt = measured(values, variances, 2);
  out.roll = measured(values, variances, 3);
  out.distance = measured(values, variances, 4);
  out.metres_per_px = measured(values, variances, 5);
  out.residual = best->residual;
  return out;
}

}  // namespace camera
}  // namespace walktrack
