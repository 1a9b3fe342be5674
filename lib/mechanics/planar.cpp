#include "mechanics/planar.h"

namespace walktrack {
inline namespace mechanics {
namespace {

using Eigen::Index;
using Eigen::Matrix2Xd;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

Index planar_row(size_t part) { return 3 * static_cast<Index>(part); }

}  // namespace

PlanarPoint::PlanarPoint(Index coordinates)
    : constant(Vector2d::Zero()),
      along(VectorXd::Zero(coordinates)),
      across(VectorXd::Zero(coordinates)),
      linear(Matrix2Xd::Zero(2, coordinates)) {}

PlanarPoint operator+(PlanarPoint a, const PlanarPoint& b) {
  a.constant += b.constant;
  a.along += b.along;
  a.across += b.across;
  a.linear += b.linear;
  return a;
}

PlanarPoint operator-(PlanarPoint a, const PlanarPoint& b) {
  a.constant -= b.constant;
  a.along -= b.along;
  a.across -= b.across;
  a.linear -= b.linear;
  return a;
}

PlanarPoint bar(Index coordinates, Index i, double along, double across) {
  PlanarPoint point(coordinates);
  point.along(i) = along;
  point.across(i) = across;
  return point;
}

Vector2d position(const PlanarPoint& point, const VectorXd& q) {
  const VectorXd s = q.array().sin(), c = q.array().cos();
  return point.constant + point.linear * q +
         Vector2d(point.along.dot(s) + point.across.dot(c),
                  point.along.dot(c) - point.across.dot(s));
}

Matrix2Xd jacobian(const PlanarPoint& point, const VectorXd& q) {
  const Eigen::ArrayXd s = q.array().sin(), c = q.array().cos();
  const Eigen::ArrayXd along = point.along.array(), across = point.across.array();
  Matrix2Xd T = point.linear;  // dp/dq_i = along w(q_i) - across u(q_i) + linear
  T.row(0) += (along * c - across * s).matrix().transpose();
  T.row(1) += (-along * s - across * c).matrix().transpose();
  return T;
}

Vector2d convective(const PlanarPoint& point, const VectorXd& q, const VectorXd& qd) {
  const VectorXd s = q.array().sin(), c = q.array().cos();
  const VectorXd squares = qd.cwiseAbs2();
  const VectorXd along = point.along.cwiseProduct(squares);
  const VectorXd across = point.across.cwiseProduct(squares);
  return -Vector2d(along.dot(s) + across.dot(c), along.dot(c) - across.dot(s));
}

MatrixXd part_jacobian(const std::vector<PlanarPart>& parts, const VectorXd& q) {
  MatrixXd T = MatrixXd::Zero(planar_row(parts.size()), q.size());
  for (size_t i = 0; i < parts.size(); ++i) {
    T.middleRows<2>(planar_row(i)) = jacobian(parts[i].com, q);
    if (parts[i].angle >= 0) T(planar_row(i) + 2, parts[i].angle) = 1;
  }
  return T;
}

VectorXd part_masses(const std::vector<PlanarPart>& parts) {
  VectorXd masses(planar_row(parts.size()));
  for (size_t i = 0; i < parts.size(); ++i) {
    masses.segment<3>(planar_row(i)) << parts[i].mass, parts[i].mass, parts[i].inertia;
  }
  return masses;
}

TmtSystem assemble(const std::vector<PlanarPart>& parts, const Vector2d& gravity, const VectorXd& q,
                   const VectorXd& qd) {
  VectorXd rates = VectorXd::Zero(planar_row(parts.size())), weight = rates;
  for (size_t i = 0; i < parts.size(); ++i) {
    rates.segment<2>(planar_row(i)) = convective(parts[i].com, q, qd);
    weight.segment<2>(planar_row(i)) = parts[i].mass * gravity;
  }
  return assemble_tmt(part_masses(parts).asDiagonal(), part_jacobian(parts, q), rates, weight);
}

PlanarMomentum momentum(const std::vector<PlanarPart>& parts, const VectorXd& q,
                        const VectorXd& qd) {
  PlanarMomentum sum;
  std::vector<Vector2d> positions, velocities;
  for (const PlanarPart& part : parts) {
    positions.push_back(position(part.com, q));
    velocities.push_back(jacobian(part.com, q) * qd);
    sum.mass += part.mass;
    sum.com += part.mass * positions.back();
    sum.linear += part.mass * velocities.back();
  }
  sum.com /= sum.mass;
  const Vector2d mean_velocity = sum.linear / sum.mass;
  for (size_t i = 0; i < parts.size(); ++i) {
    const Vector2d r = positions[i] - sum.com, v = velocities[i] - mean_velocity;
    // The y component of r x v in 3-D, r = (x, 0, z): positive rotates z towards x, i.e. forward.
    sum.angular += parts[i].mass * (r.y() * v.x() - r.x() * v.y());
    if (parts[i].angle >= 0) sum.angular += parts[i].inertia * qd(parts[i].angle);
  }
  return sum;
}

PlanarEnergy mechanical_energy(const std::vector<PlanarPart>& parts, const Vector2d& gravity,
                               const VectorXd& q, const VectorXd& qd) {
  PlanarEnergy energy;
  for (const PlanarPart& part : parts) {
    const double turn = part.angle >= 0 ? qd(part.angle) : 0.0;
    energy.kinetic += 0.5 * part.mass * (jacobian(part.com, q) * qd).squaredNorm() +
                      0.5 * part.inertia * turn * turn;
    energy.potential -= part.mass * gravity.dot(position(part.com, q));
  }
  return energy;
}

Vector2d outer_force(const std::vector<PlanarPart>& parts, const Vector2d& gravity,
                     const VectorXd& q, const VectorXd& qd, const VectorXd& qdd) {
  Vector2d force = Vector2d::Zero();
  for (const PlanarPart& part : parts) {
    const Vector2d acceleration = jacobian(part.com, q) * qdd + convective(part.com, q, qd);
    force += part.mass * (acceleration - gravity);
  }
  return force;
}

}  // namespace mechanics
}  // namespace walktrack
