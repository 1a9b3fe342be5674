// Points of the kneed walker as coefficients of u(q_k) and w(q_k); internal to lib/walker.
#pragma once

#include <array>
#include <cmath>

#include "walker/kneed/kneed_walker.h"

namespace walktrack {
inline namespace walker {

// p = (x0 + R q3, R) + sum_k [ along_k u(q_k) + across_k w(q_k) ].
struct KneedPoint {
  Vector5 along = Vector5::Zero();   // m
  Vector5 across = Vector5::Zero();  // m
};

struct KneedTrig {
  explicit KneedTrig(const Vector5& q) {
    for (int k = 0; k < 5; ++k) {
      sine[k] = std::sin(q[k]);
      cosine[k] = std::cos(q[k]);
    }
  }
  Vector5 sine, cosine;
};

using PointJacobian = Eigen::Matrix<double, 2, 5>;

// Columns dp/dq_k = along_k w(q_k) - across_k u(q_k), with (R, 0) added for the stance shank.
PointJacobian point_jacobian(const KneedPoint& point, const KneedTrig& trig, double foot_radius);

Vector2 point_position(const KneedPoint& point, const KneedTrig& trig, const KneedParameters& p,
                       const KneedState& state);

// Centres of mass in the order of q.
std::array<KneedPoint, 5> part_centres(const KneedParameters& p);
std::array<double, 5> part_masses(const KneedParameters& p);
std::array<double, 5> part_inertias(const KneedParameters& p);

KneedPoint hip_point(const KneedParameters& p);
KneedPoint swing_foot_point(const KneedParameters& p);

// In-place Cholesky factor of a symmetric positive definite matrix (lower triangle), with the
// diagonal inverted. A matrix that is not positive definite gives numbers that are not finite.
inline void factorise(Matrix5& m) {
  for (int j = 0; j < 5; ++j) {
    for (int k = 0; k < j; ++k) m(j, j) -= m(j, k) * m(j, k);
    m(j, j) = 1.0 / std::sqrt(m(j, j));
    for (int i = j + 1; i < 5; ++i) {
      for (int k = 0; k < j; ++k) m(i, j) -= m(i, k) * m(j, k);
      m(i, j) *= m(j, j);
    }
  }
}

inline Vector5 solve_factorised(const Matrix5& factor, Vector5 x) {
  for (int i = 0; i < 5; ++i) {
    for (int k = 0; k < i; ++k) x[i] -= factor(i, k) * x[k];
    x[i] *= factor(i, i);
  }
  for (int i = 4; i >= 0; --i) {
    for (int k = i + 1; k < 5; ++k) x[i] -= factor(k, i) * x[k];
    x[i] *= factor(i, i);
  }
  return x;
}

}  // namespace walker
}  // namespace walktrack
