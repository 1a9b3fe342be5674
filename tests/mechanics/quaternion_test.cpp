#include "mechanics/quaternion.h"

#include <algorithm>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "tests/mechanics/random_state.h"

namespace walktrack {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Quaternion conjugate(const Quaternion& q) { return {q(0), -q(1), -q(2), -q(3)}; }

TEST(Quaternion, ProductIsCompositionOfRotations) {
  Rng rng(1, Purpose::kTest);
  for (int i = 0; i < 50; ++i) {
    const Quaternion p = random_quaternion(rng), q = random_quaternion(rng);
    EXPECT_LT((rotation_matrix(product(p, q)) - rotation_matrix(p) * rotation_matrix(q)).norm(),
              1e-14);
    const Quaternion back = quaternion_from_rotation(rotation_matrix(q));
    EXPECT_LT(std::min((back - q).norm(), (back + q).norm()), 1e-14);
    EXPECT_LT((product(q, conjugate(q)) - identity_quaternion()).norm(), 1e-15);
  }
}

TEST(Quaternion, LeftMatrixOfUnitQuaternionIsOrthogonal) {
  Rng rng(2, Purpose::kTest);
  const Quaternion q = random_quaternion(rng);
  EXPECT_LT((left_matrix(q).transpose() - left_matrix(conjugate(q))).norm(), 1e-15);
  EXPECT_LT((left_matrix(q).transpose() * left_matrix(q) - Eigen::Matrix4d::Identity()).norm(),
            1e-14);
}

TEST(Quaternion, RateIsTheDerivativeOfTheExponentialMap) {
  Rng rng(3, Purpose::kTest);
  const Quaternion q = random_quaternion(rng);
  const Vector3d omega = random_vector(rng, 3);
  const double h = 1e-5;  // central difference: error h^2 / 6 |omega|^3 / 8 ~ 1e-11
  const Quaternion difference = product(q, quaternion_from_vector(h * omega)) -
                                product(q, quaternion_from_vector(-h * omega));
  EXPECT_LT((difference / (2 * h) - quaternion_rate(q, omega)).norm(), 1e-10);
}

TEST(Quaternion, ExponentialMapIsAxisAngleForLargeAndTinyAngles) {
  for (const double angle : {3.0, 1e-3, 1e-9, 0.0}) {
    const Vector3d axis = Vector3d(1, -2, 2) / 3;
    const Matrix3d expected = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
    EXPECT_LT((rotation_matrix(quaternion_from_vector(angle * axis)) - expected).norm(), 1e-14);
  }
  EXPECT_EQ(normalised(Quaternion::Zero()), identity_quaternion());
}

}  // namespace
}  // namespace walktrack
