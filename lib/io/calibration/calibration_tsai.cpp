#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <Eigen/Dense>
#include <Eigen/Geometry>

#include "core/errors.h"
#include "io/archive/files.h"
#include "io/calibration/calibration.h"
#include "io/calibration/calibration_checks.h"

namespace walktrack {

namespace {

// The attributes of one element, found by its name. Enough of XML for a file of three elements.
class Element {
 public:
  Element(const std::string& text, std::string file, std::string name)
      : file_(std::move(file)), name_(std::move(name)) {
    const size_t start = text.find(fmt::format("<{} ", name_));
    const size_t end = start == std::string::npos ? start : text.find('>', start);
    if (end == std::string::npos) {
      throw InputError(describe({file_, 0, ""}, fmt::format("no <{}> element", name_),
                                "a Tsai calibration with Geometry, Intrinsic and Extrinsic"));
    }
    line_ = 1 + static_cast<int>(std::count(text.begin(), text.begin() + ptrdiff_t(start), '\n'));
    attributes_ = text.substr(start, end - start);
  }

  [[noreturn]] void fail(const std::string& key, std::string_view found,
                         std::string_view allowed) const {
    throw InputError(describe({file_, line_, name_ + "." + key}, found, allowed));
  }

  double number(const std::string& key) const {
    const size_t start = attributes_.find(fmt::format(" {}=\"", key));
    if (start == std::string::npos) fail(key, "nothing", "a number");
    const size_t first = start + key.size() + 3;
    const std::string text = attributes_.substr(first, attributes_.find('"', first) - first);
    const auto value = number_from_text(text);
    if (!value) fail(key, fmt::format("'{}'", text), "a number");
    return *value;
  }

  double positive(const std::string& key) const {
    const double value = number(key);
    if (!(value > 0)) fail(key, fmt::format("{:g}", value), "a positive number");
    return value;
  }

  int pixels(const std::string& key) const {
    const double value = number(key);
    if (value != std::floor(value) || value < 1 || value > kMostPixels) {
      fail(key, fmt::format("{:g}", value), "a whole number of pixels");
    }
    return static_cast<int>(value);
  }

 private:
  std::string file_, name_, attributes_;
  int line_ = 0;
};

// Tsai undistorts, r_u = r_d (1 + kappa r_d^2); OpenCV distorts, r_d = r_u (1 + k1 r_u^2 + k2 r_u^4
// + k3 r_u^6). Least squares of r_d / r_u - 1 over the radii of the image (normalised).
std::vector<double> inverse_distortion(double kappa, double largest_radius) {
  constexpr int kSamples = 200;
  Eigen::MatrixX3d powers(kSamples, 3);
  Eigen::VectorXd change(kSamples);
  for (int i = 0; i < kSamples; ++i) {
    const double distorted = largest_radius * (i + 1) / kSamples;
    const double radius = distorted * (1 + kappa * distorted * distorted);
    const double r2 = radius * radius;
    powers.row(i) << r2, r2 * r2, r2 * r2 * r2;
    change[i] = distorted / radius - 1;
  }
  const Eigen::Vector3d k = powers.colPivHouseholderQr().solve(change);
  return {k[0], k[1], 0, 0, k[2]};
}

// Normalised distance of the image corner furthest from the principal point.
double corner_radius(const Camera& camera) {
  const Eigen::Vector2d far(
      std::max(camera.centre_px.x(), camera.width_px - camera.centre_px.x()),
      std::max(camera.centre_px.y(), camera.height_px - camera.centre_px.y()));
  return far.cwiseQuotient(camera.focal_px).norm();
}

Eigen::Matrix3d tsai_rotation(const Element& extrinsic) {
  using Eigen::AngleAxisd, Eigen::Vector3d;
  return (AngleAxisd(extrinsic.number("rz"), Vector3d::UnitZ()) *
          AngleAxisd(extrinsic.number("ry"), Vector3d::UnitY()) *
          AngleAxisd(extrinsic.number("rx"), Vector3d::UnitX()))
      .toRotationMatrix();
}

constexpr double kMetresPerMillimetre = 1e-3;

}  // namespace

// Symbols as in Tsai: focal length f and pixel pitches dpx, dpy in mm, scale sx, kappa1 in 1/mm^2.
Camera camera_from_tsai(const std::string& text, const std::string& file) {
  const Element geometry(text, file, "Geometry");
  const Element intrinsic(text, file, "Intrinsic");
  const Element extrinsic(text, file, "Extrinsic");
  Camera camera;
  camera.width_px = geometry.pixels("width");
  camera.height_px = geometry.pixels("height");
  const double f = intrinsic.positive("focal");
  camera.focal_px = {f * intrinsic.positive("sx") / geometry.positive("dpx"),
                     f / geometry.positive("dpy")};
  camera.centre_px = {intrinsic.number("cx"), intrinsic.number("cy")};
  const double kappa = intrinsic.number("kappa1") * f * f;  // of normalised radii
  if (kappa != 0) set_distortion(camera, inverse_distortion(kappa, corner_radius(camera)));
  camera.rotation = tsai_rotation(extrinsic);
  camera.translation =
      kMetresPerMillimetre *
      Eigen::Vector3d(extrinsic.number("tx"), extrinsic.number("ty"), extrinsic.number("tz"));
  return camera;
}

}  // namespace walktrack
