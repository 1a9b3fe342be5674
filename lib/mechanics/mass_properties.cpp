#include "mechanics/mass_properties.h"

#include <initializer_list>
#include <stdexcept>
#include <vector>

#include "core/conventions.h"

namespace walktrack {
inline namespace mechanics {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

// A linear function of s on [0, 1], given by its end values.
struct Linear {
  double at_0, at_1;
};

// int_0^1 of a product of linear functions: the polynomials are multiplied and integrated term by
// term.
double integral_of_product(std::initializer_list<Linear> factors) {
  std::vector<double> coefficients{1.0};
  for (const Linear& factor : factors) {
    std::vector<double> product(coefficients.size() + 1, 0.0);
    for (size_t i = 0; i < coefficients.size(); ++i) {
      product[i] += coefficients[i] * factor.at_0;
      product[i + 1] += coefficients[i] * (factor.at_1 - factor.at_0);
    }
    coefficients = product;
  }
  double sum = 0;
  for (size_t i = 0; i < coefficients.size(); ++i) {
    sum += coefficients[i] / static_cast<double>(i + 1);
  }
  return sum;
}

// |r|^2 E - r r^T
Matrix3d steiner(const Vector3d& r) {
  return r.squaredNorm() * Matrix3d::Identity() - r * r.transpose();
}

// Inertia from the second moments int x^2, int y^2, int z^2 (times density) of a symmetric solid.
Matrix3d inertia_from_moments(double xx, double yy, double zz) {
  return Vector3d(yy + zz, xx + zz, xx + yy).asDiagonal();
}

void require(bool condition, const char* message) {
  if (!condition) throw std::invalid_argument(message);
}

}  // namespace

MassProperties ellipsoid(double density, const Vector3d& semi_axes) {
  require(density >= 0 && semi_axes.minCoeff() >= 0, "ellipsoid: negative density or semi-axis");
  const double mass = density * 4.0 / 3.0 * kPi * semi_axes.prod();
  const Vector3d second = mass / 5.0 * semi_axes.cwiseAbs2();
  return {mass, Vector3d::Zero(), inertia_from_moments(second.x(), second.y(), second.z())};
}

MassProperties elliptic_frustum(double density, double length, const Vector2d& base,
                                const Vector2d& top) {
  require(density >= 0 && length >= 0 && base.minCoeff() >= 0 && top.minCoeff() >= 0,
          "elliptic_frustum: negative density, length or semi-axis");
  const Linear a{base.x(), top.x()}, b{base.y(), top.y()}, z{0, length};
  // A section of semi-axes a, b has area pi a b and second moments pi a^3 b / 4, pi a b^3 / 4.
  const double scale = density * kPi * length;
  const double mass = scale * integral_of_product({a, b});
  if (mass == 0) return {};
  const double height = scale * integral_of_product({a, b, z}) / mass;
  const double xx = scale / 4 * integral_of_product({a, a, a, b});
  const double yy = scale / 4 * integral_of_product({a, b, b, b});
  const Linear from_com{-height, length - height};
  const double zz = scale * integral_of_product({a, b, from_com, from_com});
  return {mass, Vector3d(0, 0, height), inertia_from_moments(xx, yy, zz)};
}

MassProperties capsule(double density, double length, double radius) {
  require(density >= 0 && length >= 0 && radius >= 0, "capsule: negative density or size");
  const double r2 = radius * radius;
  const double cylinder = density * kPi * r2 * length;
  const double half_sphere = density * 2.0 / 3.0 * kPi * r2 * radius;
  // The centre of a half sphere is 3r/8 from its flat face, its second moments are 2/5, 1/5 m r^2
  // about the centre of the sphere.
  const double along = cylinder * length * length / 12 +
                       2 * half_sphere * (r2 / 5 + length * length / 4 + 3.0 / 8 * length * radius);
  const double across = cylinder * r2 / 4 + 2 * half_sphere * r2 / 5;
  return {cylinder + 2 * half_sphere, Vector3d(0, 0, length / 2),
          inertia_from_moments(across, across, along)};
}

MassProperties transformed(const MassProperties& solid, const Matrix3d& rotation,
                           const Vector3d& translation) {
  return {solid.mass, rotation * solid.com + translation,
          rotation * solid.inertia * rotation.transpose()};
}

MassProperties combined(std::span<const MassProperties> solids) {
  MassProperties whole;
  Vector3d moment = Vector3d::Zero();
  for (const MassProperties& solid : solids) {
    whole.mass += solid.mass;
    moment += solid.mass * solid.com;
  }
  if (whole.mass > 0) whole.com = moment / whole.mass;
  for (const MassProperties& solid : solids) whole.inertia += inertia_about(solid, whole.com);
  return whole;
}

Matrix3d inertia_about(const MassProperties& solid, const Vector3d& point) {
  return solid.inertia + solid.mass * steiner(solid.com - point);
}

}  // namespace mechanics
}  // namespace walktrack
