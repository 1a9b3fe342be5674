#include "mechanics/mass_properties.h"

#include <algorithm>
#include <array>
#include <functional>
#include <stdexcept>

#include <gtest/gtest.h>
#include <Eigen/LU>

#include "core/conventions.h"
#include "tests/mechanics/random_state.h"

namespace walktrack {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

// The definition itself: sums over the cells of a fine grid whose centres are inside.
MassProperties brute_force(const Vector3d& low, const Vector3d& high,
                           const std::function<bool(const Vector3d&)>& inside) {
  constexpr int kCells = 120;
  const Vector3d cell = (high - low) / kCells;
  double mass = 0;
  Vector3d first = Vector3d::Zero();
  Matrix3d second = Matrix3d::Zero();
  for (int i = 0; i < kCells; ++i) {
    for (int j = 0; j < kCells; ++j) {
      for (int k = 0; k < kCells; ++k) {
        const Vector3d r = low + cell.cwiseProduct(Vector3d(i + 0.5, j + 0.5, k + 0.5));
        if (!inside(r)) continue;
        mass += cell.prod();
        first += cell.prod() * r;
        second += cell.prod() * r * r.transpose();
      }
    }
  }
  const Vector3d com = first / mass;
  const Matrix3d central = second - mass * com * com.transpose();
  return {mass, com, central.trace() * Matrix3d::Identity() - central};
}

// With 120 cells across, the surface is uncertain by a part in a few hundred.
void expect_close(const MassProperties& exact, const MassProperties& grid) {
  EXPECT_NEAR(exact.mass, grid.mass, 3e-3 * exact.mass);
  EXPECT_LT((exact.com - grid.com).norm(), 3e-3);
  EXPECT_LT((exact.inertia - grid.inertia).norm(), 6e-3 * exact.inertia.norm());
}

TEST(MassProperties, EllipticFrustumMatchesItsDefinition) {
  const Vector2d base(0.5, 0.3), top(0.2, 0.6);
  const double length = 1.2;
  const auto inside = [&](const Vector3d& r) {
    const Vector2d axes = base + r.z() / length * (top - base);
    return r.head<2>().cwiseQuotient(axes).squaredNorm() < 1;
  };
  expect_close(elliptic_frustum(1, length, base, top),
               brute_force({-0.6, -0.6, 0}, {0.6, 0.6, length}, inside));
}

TEST(MassProperties, EllipsoidAndCapsuleMatchTheirDefinition) {
  const Vector3d axes(0.5, 0.3, 0.7);
  expect_close(ellipsoid(1, axes), brute_force(-axes, axes, [&](const Vector3d& r) {
                 return r.cwiseQuotient(axes).squaredNorm() < 1;
               }));
  const double length = 0.8, radius = 0.3;
  const auto inside = [&](const Vector3d& r) {
    const double z = std::clamp(r.z(), 0.0, length);
    return (r - Vector3d(0, 0, z)).norm() < radius;
  };
  expect_close(capsule(1, length, radius),
               brute_force({-radius, -radius, -radius}, {radius, radius, length + radius}, inside));
}

TEST(MassProperties, TextbookSpecialCases) {
  // Solid sphere 2/5 m r^2; cylinder m (3 r^2 + L^2) / 12; cone: com L/4 from the base, 3/10 m r^2.
  const MassProperties sphere = ellipsoid(2, Vector3d::Constant(0.5));
  EXPECT_NEAR(sphere.inertia(0, 0), 0.4 * sphere.mass * 0.25, 1e-15);
  const MassProperties cylinder = elliptic_frustum(3, 2, {0.5, 0.5}, {0.5, 0.5});
  EXPECT_NEAR(cylinder.inertia(0, 0), cylinder.mass * (3 * 0.25 + 4) / 12, 1e-13);
  const MassProperties cone = elliptic_frustum(3, 2, {0.5, 0.5}, {0, 0});
  EXPECT_NEAR(cone.mass, 3 * kPi * 0.25 * 2 / 3, 1e-14);
  EXPECT_NEAR(cone.com.z(), 0.5, 1e-14);
  EXPECT_NEAR(cone.inertia(2, 2), 0.3 * cone.mass * 0.25, 1e-14);
  EXPECT_NEAR(capsule(1, 0, 0.5).inertia(2, 2), ellipsoid(1, Vector3d::Constant(0.5)).inertia(2, 2),
              1e-15);
}

TEST(MassProperties, TwoHalvesAreTheWhole) {
  const MassProperties half = elliptic_frustum(5, 0.5, {0.2, 0.1}, {0.2, 0.1});
  const std::array halves{half, transformed(half, Matrix3d::Identity(), {0, 0, 0.5})};
  const MassProperties joined = combined(halves);
  const MassProperties whole = elliptic_frustum(5, 1, {0.2, 0.1}, {0.2, 0.1});
  EXPECT_NEAR(joined.mass, whole.mass, 1e-14);
  EXPECT_LT((joined.com - whole.com).norm(), 1e-14);
  EXPECT_LT((joined.inertia - whole.inertia).norm(), 1e-14);
}

TEST(MassProperties, EdgeCases) {
  EXPECT_EQ(elliptic_frustum(1, 0, {1, 1}, {1, 1}).mass, 0);
  EXPECT_EQ(combined({}).mass, 0);
  EXPECT_THROW(capsule(1, -1, 1), std::invalid_argument);
  EXPECT_THROW(ellipsoid(-1, {1, 1, 1}), std::invalid_argument);
  EXPECT_THROW(elliptic_frustum(1, 1, {1, -1}, {1, 1}), std::invalid_argument);
}

}  // namespace
}  // namespace walktrack
