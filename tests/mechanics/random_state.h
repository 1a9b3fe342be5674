// Random vectors and rotations for the tests of mechanics and walker.
#pragma once

#include <Eigen/Core>

#include "core/rng.h"
#include "mechanics/quaternion.h"

namespace walktrack {

// Uniform in [-size, size].
inline Eigen::VectorXd random_vector(Rng& rng, Eigen::Index n, double size = 1) {
  Eigen::VectorXd v(n);
  for (double& x : v) x = size * (2 * rng.uniform() - 1);
  return v;
}

inline Quaternion random_quaternion(Rng& rng) {
  Quaternion q;
  for (double& x : q) x = rng.normal();
  return normalised(q);
}

}  // namespace walktrack
