#include "mechanics/articulated_dynamics.h"

#include <array>
#include <cmath>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "core/conventions.h"
#include "tests/mechanics/rigid_body.h"
#include "tests/mechanics/sample_bodies.h"

namespace walktrack {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

TEST(ArticulatedDynamics, InverseUndoesForward) {
  const ArticulatedBody body = sample_body();
  Rng rng(41, Purpose::kTest);
  for (int i = 0; i < 50; ++i) {
    const VectorXd q = random_positions(body, rng), u = random_vector(rng, body.velocities(), 3);
    BodyLoad load;
    load.joint_forces = random_vector(rng, body.velocities(), 20);
    load.forces.push_back(
        {3, random_vector(rng, 3), random_vector(rng, 3, 50), random_vector(rng, 3, 5)});
    const VectorXd u_dot = forward_dynamics(body, q, u, load, {}, 0).u_dot;
    const InverseDynamics inverse = inverse_dynamics(body, q, u, u_dot, load);
    EXPECT_LT((inverse.tau - load.joint_forces).norm(), 1e-11 * (1 + u_dot.norm()));
  }
}

TEST(ArticulatedDynamics, OnePartIsTheRigidBody) {
  Rng rng(42, Purpose::kTest);
  ArticulatedPart part;
  part.mass = elliptic_frustum(1000, 0.5, {0.1, 0.2}, {0.1, 0.05});
  part.mass.com.setZero();
  const ArticulatedBody body({part});
  const RigidBody rigid{part.mass.mass, part.mass.inertia};
  const VectorXd q = random_positions(body, rng), u = random_vector(rng, 6, 3);
  BodyLoad load;
  load.joint_forces = random_vector(rng, 6, 10);
  const VectorXd u_dot = forward_dynamics(body, q, u, load, {}, 0).u_dot;
  const Vector3d fall = load.joint_forces.head<3>() / rigid.mass + load.gravity;
  EXPECT_LT((u_dot.head<3>() - fall).norm(), 1e-13);
  const Vector3d alpha =
      angular_acceleration(rigid, u.segment<3>(3), load.joint_forces.segment<3>(3));
  EXPECT_LT((u_dot.tail<3>() - alpha).norm(), 1e-12);
}

struct Motion {
  ArticulatedState state;
  double energy(const ArticulatedBody& body) const {
    const BodyMomentum m = body_momentum(body, state.q, state.u);
    return m.kinetic_energy + body.mass() * kStandardGravity * m.com.z();
  }
};

Motion moved(const ArticulatedBody& body, Motion start, std::span<const Attachment> held, double dt,
             double time, const ArticulatedStepOptions& options) {
  BodyLoad load;
  load.gravity = Vector3d(0, 0, -kStandardGravity);
  for (int i = 0; i < static_cast<int>(std::lround(time / dt)); ++i) {
    start.state = *step(body, start.state, load, held, dt, options);
  }
  return start;
}

Motion tumbling(const ArticulatedBody& body) {
  Rng rng(43, Purpose::kTest);
  return {{random_positions(body, rng), random_vector(rng, body.velocities(), 1)}};
}

TEST(ArticulatedDynamics, FlightKeepsEnergyAndAngularMomentum) {
  const ArticulatedBody body = sample_body();
  const Motion start = tumbling(body);
  const auto drift = [&](Integrator integrator, double dt) {
    return std::abs(moved(body, start, {}, dt, 0.4, {.integrator = integrator}).energy(body) -
                    start.energy(body));
  };
  EXPECT_NEAR(std::log2(drift(Integrator::kEuler, 1e-3) / drift(Integrator::kEuler, 5e-4)), 1, 0.1);
  EXPECT_NEAR(std::log2(drift(Integrator::kRk4, 0.02) / drift(Integrator::kRk4, 0.01)), 4, 0.7);
  const Motion end = moved(body, start, {}, 2e-3, 0.4, {});
  const Vector3d before = body_momentum(body, start.state.q, start.state.u).angular;
  const Vector3d after = body_momentum(body, end.state.q, end.state.u).angular;
  EXPECT_LT((after - before).norm(), 1e-8 * before.norm());  // RK4 at 2 ms
}

TEST(ArticulatedDynamics, HeldBodyKeepsItsEnergyAndItsHold) {
  const ArticulatedBody body = sample_body();
  Motion start = tumbling(body);
  const auto motions =
      part_motions(body, start.state.q, start.state.u, VectorXd::Zero(body.velocities()));
  const Vector3d hand(0.1, 0, 0.3);
  const std::array<Attachment, 1> held{{{3, hand, point_position(motions[3], hand)}}};
  const auto miss = [&](const Motion& r) {
    return attachment_constraint(body, r.state.q, r.state.u, held).value.norm();
  };
  const TmtSystem system = assemble(body, start.state.q, start.state.u, {});
  start.state.u = projected_velocity(
      system.mass, attachment_constraint(body, start.state.q, start.state.u, held), start.state.u);
  const Motion projected = moved(body, start, held, 2e-3, 0.6, {});
  EXPECT_LT(miss(projected), 1e-13);
  EXPECT_NEAR(projected.energy(body), start.energy(body), 1e-6 * std::abs(start.energy(body)));
  const auto by_euler = [&](Stabilisation s) {
    return miss(moved(body, start, held, 1e-3, 0.6,
                      {.integrator = Integrator::kEuler, .stabilisation = s}));
  };
  EXPECT_GT(by_euler(Stabilisation::kNone), 1e-3);
  EXPECT_LT(by_euler(Stabilisation::kBaumgarte), by_euler(Stabilisation::kNone) / 2);
  EXPECT_LT(by_euler(Stabilisation::kProjection), 1e-13);
}

// A body at rest on two attached points: the attachments carry the weight.
TEST(ArticulatedDynamics, AttachmentForcesBalanceTheWeight) {
  const ArticulatedBody body = sample_body();
  Rng rng(44, Purpose::kTest);
  const VectorXd q = random_positions(body, rng), u = VectorXd::Zero(body.velocities());
  const auto motions = part_motions(body, q, u, u);
  std::vector<Attachment> held;
  for (size_t part = 0; part < 4; ++part) {
    const Vector3d point = random_vector(rng, 3);
    held.push_back({part, point, point_position(motions[part], point)});
  }
  const ForwardDynamics found = forward_dynamics(body, q, u, {}, held, 0);
  // Newton: the sum of the external forces is the rate of change of linear momentum.
  Vector3d sum = body.mass() * Vector3d(0, 0, -kStandardGravity);
  for (const Vector3d& force : found.attachment_forces) sum += force;
  const double h = 1e-6;
  const VectorXd later = h * found.u_dot;
  const Vector3d rate =
      (body_momentum(body, q, later).linear - body_momentum(body, q, -later).linear) / (2 * h);
  EXPECT_LT((sum - rate).norm(), 1e-6);
}

// The missing force and torque at the root are the ground reaction: they equal the rate of change
// of the whole body's momentum minus the weight, by an independent difference quotient.
TEST(ArticulatedDynamics, RootResidualIsTheGroundReaction) {
  const ArticulatedBody body = sample_body();
  Rng rng(45, Purpose::kTest);
  const VectorXd q = random_positions(body, rng), u = random_vector(rng, body.velocities(), 2);
  const VectorXd u_dot = random_vector(rng, body.velocities(), 5);
  const InverseDynamics inverse = inverse_dynamics(body, q, u, u_dot, {});
  const double h = 1e-5;
  const auto at = [&](double t) {
    return body_momentum(body, body.advanced(q, t * (u + t / 2 * u_dot)), u + t * u_dot);
  };
  const Vector3d weight = body.mass() * Vector3d(0, 0, -kStandardGravity);
  const Vector3d rate = (at(h).linear - at(-h).linear) / (2 * h);
  EXPECT_LT((inverse.joint_force[0] + weight - rate).norm(), 1e-6);
  const Vector3d arm = q.head<3>() - at(0).com;
  const Vector3d spin = (at(h).angular - at(-h).angular) / (2 * h);
  EXPECT_LT((inverse.joint_moment[0] + arm.cross(inverse.joint_force[0]) - spin).norm(), 1e-6);
}

TEST(ArticulatedDynamics, ReportsDivergence) {
  const ArticulatedBody body = sample_body();
  ArticulatedState state{body.zero_positions(), VectorXd::Constant(body.velocities(), 1e200)};
  EXPECT_FALSE(step(body, state, {}, {}, 1, {}).has_value());
}

}  // namespace
}  // namespace walktrack
