#include "jobs/calibrate/calibrate_place.h"

#include <cmath>

#include <fmt/format.h>

#include "core/errors.h"

namespace walktrack {
inline namespace jobs {

namespace {

// Points that are marked by hand are off by a few pixels; a share of the image width above this
// limit is a mistake.
constexpr double kLargestRmsShare = 0.01;

bool plausible(const std::optional<PlaceFit>& fit, const Camera& lens) {
  return fit && fit->rms_px < kLargestRmsShare * lens.width_px &&
         camera_centre(fit->camera).z() > 0;
}

// The point without which the others fit best.
size_t odd_one_out(const Camera& lens, const MeasuredPoints& points, double& rms_without) {
  size_t odd = 0;
  rms_without = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < points.pixels.size(); ++i) {
    MeasuredPoints rest = points;
    rest.pixels.erase(rest.pixels.begin() + static_cast<std::ptrdiff_t>(i));
    rest.world.erase(rest.world.begin() + static_cast<std::ptrdiff_t>(i));
    const auto fit = fit_place(lens, rest.pixels, rest.world);
    if (fit && fit->rms_px < rms_without) {
      rms_without = fit->rms_px;
      odd = i;
    }
  }
  return odd;
}

[[noreturn]] void explain(const Camera& lens, const MeasuredPoints& points,
                          const std::optional<PlaceFit>& fit, const std::string& file) {
  MeasuredPoints mirrored = points;
  for (Eigen::Vector3d& point : mirrored.world) point.y() = -point.y();
  if (plausible(fit_place(lens, mirrored.pixels, mirrored.world), lens))
    throw InputError(describe({file, 0, ""}, "mirrored axes: the points fit with -y for y",
                              "right-handed axes with z up; from above, y is to the left of x"));
  const std::string allowed = fmt::format("at most {:.1f} px: pixels, metres or the lens are wrong",
                                          kLargestRmsShare * lens.width_px);
  if (!fit || !std::isfinite(fit->rms_px))
    throw InputError(describe({file, 0, ""}, "points that fit no place of the camera", allowed));
  if (camera_centre(fit->camera).z() <= 0)
    throw InputError(describe({file, 0, ""}, "a camera under the ground", "z up, ground z = 0"));
  double rms_without = 0;
  const size_t odd = odd_one_out(lens, points, rms_without);
  const bool alone = points.pixels.size() > 5 && rms_without < 0.3 * fit->rms_px;
  throw InputError(describe(
      {file, alone ? points.lines[odd] : 0, ""},
      alone ? fmt::format("a point that does not fit the others; the reprojection error without it "
                          "is {:.1f} px, with it",
                          rms_without) +
                  fmt::format(" {:.1f} px", fit->rms_px)
            : fmt::format("points with reprojection errors of {:.1f} px (rms)", fit->rms_px),
      allowed));
}

}  // namespace

PlaceFit checked_place(const Camera& lens, const MeasuredPoints& points, const std::string& file) {
  auto fit = fit_place(lens, points.pixels, points.world);
  if (!plausible(fit, lens)) explain(lens, points, fit, file);
  return *fit;
}

}  // namespace jobs
}  // namespace walktrack
