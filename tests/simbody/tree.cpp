#include "tests/simbody/tree.h"

#include <Simbody.h>

#include <Eigen/Geometry>

namespace simbody {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

SimTK::Vec3 vec(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }
Vector3d vec(const SimTK::Vec3& v) { return {v[0], v[1], v[2]}; }

SimTK::Rotation rotation(const Matrix3d& r) {
  return {
      SimTK::Mat33(r(0, 0), r(0, 1), r(0, 2), r(1, 0), r(1, 1), r(1, 2), r(2, 0), r(2, 1), r(2, 2)),
      true};
}

SimTK::Body::Rigid rigid(const Part& part) {
  const Matrix3d& i = part.inertia;
  const SimTK::Inertia inertia(i(0, 0), i(1, 1), i(2, 2), i(0, 1), i(0, 2), i(1, 2));
  return SimTK::Body::Rigid(SimTK::MassProperties(part.mass, vec(part.com), inertia));
}

struct System {
  SimTK::MultibodySystem system;
  SimTK::SimbodyMatterSubsystem matter{system};
  std::vector<SimTK::MobilizedBody> bodies;

  // Mobilizers rotate about the z axis of their frames: `turn` maps it to the pin's axis.
  void add(const Part& part, SimTK::MobilizedBody& parent) {
    Matrix3d turn = Matrix3d::Identity();
    if (part.joint == Joint::kPin) {
      turn = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), part.axis).toRotationMatrix();
    }
    const SimTK::Transform inboard(rotation(part.rest * turn), vec(part.anchor));
    const SimTK::Transform outboard(rotation(turn), SimTK::Vec3(0));
    switch (part.joint) {
      case Joint::kFree:
        bodies.push_back(SimTK::MobilizedBody::Free(parent, inboard, rigid(part), outboard));
        break;
      case Joint::kPin:
        bodies.push_back(SimTK::MobilizedBody::Pin(parent, inboard, rigid(part), outboard));
        break;
      case Joint::kBall:
        bodies.push_back(SimTK::MobilizedBody::Ball(parent, inboard, rigid(part), outboard));
        break;
      case Joint::kWeld:
        bodies.push_back(SimTK::MobilizedBody::Weld(parent, inboard, rigid(part), outboard));
        break;
    }
  }

  void set_motion(SimTK::State& state, const Part& part, const std::vector<Motion>& motions,
                  size_t i) {
    const Motion ground{Matrix3d::Identity(), Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero()};
    const bool is_root = part.parent < 0;
    const Motion& base = is_root ? ground : motions[static_cast<size_t>(part.parent)];
    const SimTK::Transform own(rotation(motions[i].rotation), vec(motions[i].origin));
    const SimTK::Transform parent(rotation(base.rotation), vec(base.origin));
    const SimTK::Transform inboard = parent * bodies[i].getInboardFrame(state);
    const SimTK::Transform outboard = own * bodies[i].getOutboardFrame(state);
    bodies[i].setQToFitTransform(state, ~inboard * outboard);
    // The outboard frame is at the joint: only a free root moves away from its inboard frame.
    const SimTK::Vec3 omega = vec(Vector3d(motions[i].omega - base.omega));
    const SimTK::Vec3 velocity = is_root ? vec(motions[i].velocity) : SimTK::Vec3(0);
    bodies[i].setUToFitVelocity(state,
                                SimTK::SpatialVec(~inboard.R() * omega, ~inboard.R() * velocity));
  }
};

}  // namespace

std::vector<Acceleration> accelerations(const std::vector<Part>& parts,
                                        const std::vector<Motion>& motions,
                                        const std::vector<Load>& loads) {
  System tree;
  for (const Part& part : parts) {
    tree.add(part, part.parent < 0 ? static_cast<SimTK::MobilizedBody&>(tree.matter.Ground())
                                   : tree.bodies[static_cast<size_t>(part.parent)]);
  }
  SimTK::State state = tree.system.realizeTopology();
  for (size_t i = 0; i < parts.size(); ++i) tree.set_motion(state, parts[i], motions, i);
  tree.system.realize(state, SimTK::Stage::Dynamics);
  SimTK::Vector_<SimTK::SpatialVec> applied(tree.matter.getNumBodies(),
                                            SimTK::SpatialVec(SimTK::Vec3(0)));
  for (size_t i = 0; i < parts.size(); ++i) {
    applied[tree.bodies[i].getMobilizedBodyIndex()] =
        SimTK::SpatialVec(vec(loads[i].torque), vec(loads[i].force));
  }
  SimTK::Vector u_dot;
  SimTK::Vector_<SimTK::SpatialVec> found;
  tree.matter.calcAccelerationIgnoringConstraints(state, SimTK::Vector(state.getNU(), 0.0), applied,
                                                  u_dot, found);
  std::vector<Acceleration> result;
  for (const auto& body : tree.bodies) {
    const SimTK::SpatialVec a = found[body.getMobilizedBodyIndex()];
    result.push_back({vec(a[0]), vec(a[1])});
  }
  return result;
}

std::vector<double> rolling_chain(const std::vector<Part>& parts, double wheel_radius,
                                  const std::vector<double>& angles,
                                  const std::vector<double>& rates, double gravity_x,
                                  double gravity_z, const std::vector<double>& torques) {
  System chain;
  SimTK::GeneralForceSubsystem forces(chain.system);
  const SimTK::Vec3 g(gravity_x, 0, gravity_z);
  SimTK::Force::UniformGravity gravity(forces, chain.matter, g);
  SimTK::Force::DiscreteForces couples(forces, chain.matter);
  // A massless carriage slides along x at the height of the wheel's centre.
  SimTK::MobilizedBody::Slider carriage(chain.matter.Ground(),
                                        SimTK::Transform(SimTK::Vec3(0, 0, wheel_radius)),
                                        SimTK::Body::Massless(), SimTK::Transform());
  for (const Part& part : parts) {
    chain.add(part, part.parent < 0 ? static_cast<SimTK::MobilizedBody&>(carriage)
                                    : chain.bodies[static_cast<size_t>(part.parent)]);
  }
  // x - R angle = 0
  SimTK::Vector coefficients(3, 0.0);
  coefficients[0] = 1;
  coefficients[1] = -wheel_radius;
  const std::vector<SimTK::MobilizedBodyIndex> coupled{carriage.getMobilizedBodyIndex(),
                                                       chain.bodies[0].getMobilizedBodyIndex()};
  SimTK::Constraint::CoordinateCoupler roll(
      chain.matter, new SimTK::Function::Linear(coefficients), coupled,
      std::vector<SimTK::MobilizerQIndex>(2, SimTK::MobilizerQIndex(0)));
  SimTK::State state = chain.system.realizeTopology();
  carriage.setOneQ(state, 0, wheel_radius * angles[0]);
  carriage.setOneU(state, 0, wheel_radius * rates[0]);
  for (size_t i = 0; i < parts.size(); ++i) {
    const bool is_root = parts[i].parent < 0;
    const auto parent = static_cast<size_t>(is_root ? 0 : parts[i].parent);
    chain.bodies[i].setOneQ(state, 0, angles[i] - (is_root ? 0 : angles[parent]));
    chain.bodies[i].setOneU(state, 0, rates[i] - (is_root ? 0 : rates[parent]));
    couples.setOneBodyForce(state, chain.bodies[i],
                            SimTK::SpatialVec(SimTK::Vec3(0, torques[i], 0), SimTK::Vec3(0)));
  }
  chain.system.realize(state, SimTK::Stage::Acceleration);
  std::vector<double> result;
  for (const auto& body : chain.bodies) {
    result.push_back(body.getBodyAngularAcceleration(state)[1]);
  }
  return result;
}

}  // namespace simbody
