#include "mechanics/articulated.h"

#include <stdexcept>

#include <gtest/gtest.h>

#include "tests/mechanics/sample_bodies.h"

namespace walktrack {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kStep = 1e-5;  // central differences err by kStep^2 and 1e-16 / kStep
constexpr double kClose = 1e-8;

// S with S r = v x r.
Matrix3d cross_matrix(const Vector3d& v) {
  Matrix3d cross;
  for (int k = 0; k < 3; ++k) cross.col(k) = v.cross(Vector3d::Unit(k));
  return cross;
}

class ArticulatedMotion : public testing::Test {
 protected:
  ArticulatedMotion() : rng_(31, Purpose::kTest) {
    q_ = random_positions(body_, rng_);
    u_ = random_vector(rng_, body_.velocities(), 2);
    u_dot_ = random_vector(rng_, body_.velocities(), 2);
  }
  // The configuration after time t under u, u_dot: exact to second order by the midpoint velocity.
  std::vector<PartMotion> at(double t) const {
    return part_motions(body_, body_.advanced(q_, t * (u_ + t / 2 * u_dot_)), u_ + t * u_dot_,
                        VectorXd::Zero(body_.velocities()));
  }
  ArticulatedBody body_ = sample_body();
  Rng rng_;
  VectorXd q_, u_, u_dot_;
};

TEST_F(ArticulatedMotion, VelocitiesAndAccelerationsAreDerivativesOfPositions) {
  const auto now = part_motions(body_, q_, u_, u_dot_);
  const auto later = at(kStep), earlier = at(-kStep);
  const Vector3d point(0.1, -0.2, 0.3);
  for (size_t i = 0; i < now.size(); ++i) {
    const auto rate = [&](const auto& f) {
      return Vector3d((f(later[i]) - f(earlier[i])) / (2 * kStep));
    };
    const auto where = [&](const PartMotion& m) { return point_position(m, point); };
    const auto speed = [&](const PartMotion& m) { return point_velocity(m, point); };
    const auto turn = [&](const PartMotion& m) { return m.omega; };
    EXPECT_LT((point_velocity(now[i], point) - rate(where)).norm(), kClose) << "part " << i;
    EXPECT_LT((point_acceleration(now[i], point) - rate(speed)).norm(), kClose) << "part " << i;
    EXPECT_LT((now[i].alpha - rate(turn)).norm(), kClose) << "part " << i;
    const Matrix3d spin = (later[i].rotation - earlier[i].rotation) / (2 * kStep);
    EXPECT_LT((spin * now[i].rotation.transpose() - cross_matrix(now[i].omega)).norm(), kClose);
  }
}

TEST_F(ArticulatedMotion, JacobiansGiveTheVelocities) {
  const auto motions = part_motions(body_, q_, u_, u_dot_);
  const Vector3d point(0.1, -0.2, 0.3);
  for (size_t i = 0; i < motions.size(); ++i) {
    EXPECT_LT(
        (point_jacobian(body_, motions, i, point) * u_ - point_velocity(motions[i], point)).norm(),
        1e-13);
    EXPECT_LT((rotation_jacobian(body_, motions, i) * u_ - motions[i].omega).norm(), 1e-13);
  }
}

TEST_F(ArticulatedMotion, PositionRateIsTheDerivativeOfAdvanced) {
  const VectorXd difference =
      (body_.advanced(q_, kStep * u_) - body_.advanced(q_, -kStep * u_)) / (2 * kStep);
  EXPECT_LT((difference - body_.position_rate(q_, u_)).norm(), kClose);
}

TEST_F(ArticulatedMotion, MomentumIsMassTimesVelocityOfTheCentreOfMass) {
  const auto com = [&](double t) {
    return body_momentum(body_, body_.advanced(q_, t * u_), u_).com;
  };
  const Vector3d velocity = (com(kStep) - com(-kStep)) / (2 * kStep);
  EXPECT_LT((body_momentum(body_, q_, u_).linear / body_.mass() - velocity).norm(), kClose);
}

TEST(Articulated, RejectsDisorderedTreesAndBadAxes) {
  Rng rng(1, Purpose::kTest);
  const ArticulatedPart root = sample_part(rng, -1, JointKind::kFixed);
  ArticulatedPart orphan = sample_part(rng, 1, JointKind::kHinge);
  EXPECT_THROW(ArticulatedBody({root, orphan}), std::invalid_argument);
  EXPECT_THROW(ArticulatedBody({}), std::invalid_argument);
  ArticulatedPart bent = sample_part(rng, 0, JointKind::kHinge);
  bent.axis *= 2;
  EXPECT_THROW(ArticulatedBody({root, bent}), std::invalid_argument);
}

}  // namespace
}  // namespace walktrack
