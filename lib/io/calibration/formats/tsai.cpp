#include "io/calibration/formats/tsai.h"

#include <algorithm>
#include <vector>

#include <Eigen/Geometry>

#include "core/conventions.h"
#include "core/dense.h"
#include "io/calibration/xml_element.h"

namespace walktrack {
inline namespace io {

namespace {

constexpr const char* kTsai = "a Tsai calibration with Geometry, Intrinsic and Extrinsic";

// Tsai's model undistorts, r_u = r_d (1 + kappa r_d^2); OpenCV's distorts, r_d = r_u (1 + k1 r_u^2
// + k2 r_u^4 + k3 r_u^6). The coefficients minimise the squares of r_d / r_u - 1 over the
// normalised radii of the image.
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
  const Eigen::Vector3d k = least_squares(powers, change);
  return {k[0], k[1], 0, 0, k[2]};
}

// Normalised distance between the principal point and the image corner that is furthest from it.
double corner_radius(const Camera& camera) {
  const Eigen::Vector2d far(
      std::max(camera.centre_px.x(), camera.width_px - camera.centre_px.x()),
      std::max(camera.centre_px.y(), camera.height_px - camera.centre_px.y()));
  return far.cwiseQuotient(camera.focal_px).norm();
}

Eigen::Matrix3d tsai_rotation(const XmlElement& extrinsic) {
  using Eigen::AngleAxisd, Eigen::Vector3d;
  return (AngleAxisd(extrinsic.number("rz"), Vector3d::UnitZ()) *
          AngleAxisd(extrinsic.number("ry"), Vector3d::UnitY()) *
          AngleAxisd(extrinsic.number("rx"), Vector3d::UnitX()))
      .toRotationMatrix();
}

}  // namespace

// Symbols as in Tsai: focal length f and pixel pitches dpx, dpy in mm, scale sx, kappa1 in 1/mm^2.
Camera camera_from_tsai(const std::string& text, const std::string& file) {
  const XmlElement geometry(text, file, "Geometry", kTsai);
  const XmlElement intrinsic(text, file, "Intrinsic", kTsai);
  const XmlElement extrinsic(text, file, "Extrinsic", kTsai);
  Camera camera;
  camera.width_px = geometry.pixels("width");
  camera.height_px = geometry.pixels("height");
  const double f = intrinsic.positive("focal");
  camera.focal_px = {f * intrinsic.positive("sx") / geometry.positive("dpx"),
                     f / geometry.positive("dpy")};
  camera.centre_px = {intrinsic.number("cx"), intrinsic.number("cy")};
  const double kappa = intrinsic.number("kappa1") * f * f;  // for normalised radii
  if (kappa != 0) set_distortion(camera, inverse_distortion(kappa, corner_radius(camera)));
  camera.rotation = tsai_rotation(extrinsic);
  camera.translation =
      kMetresPerMillimetre *
      Eigen::Vector3d(extrinsic.number("tx"), extrinsic.number("ty"), extrinsic.number("tz"));
  return camera;
}

}  // namespace io
}  // namespace walktrack
