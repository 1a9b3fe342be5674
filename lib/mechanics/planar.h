// Planar linkages in absolute angles, assembled by the TMT method. Plane: x forward, z up; angles
// as in core/conventions.h. Every point of every planar walker has the form
//   p(q) = constant + sum_i [ along_i u(q_i) + across_i w(q_i) + linear_i q_i ],
//   u(a) = (sin a, cos a),  w(a) = (cos a, -sin a):
// `linear` contains translating coordinates (the hip in flight) and a rolling foot (R, 0). Points
// can be added and subtracted, so that a chain is written as knee = ankle + shank.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "mechanics/tmt.h"

namespace walktrack {
inline namespace mechanics {

struct PlanarPoint {
  explicit PlanarPoint(Eigen::Index coordinates);

  Eigen::Vector2d constant;  // m
  Eigen::VectorXd along;     // m, per coordinate
  Eigen::VectorXd across;    // m
  Eigen::Matrix2Xd linear;   // m per rad, or 1 for a translation
};

PlanarPoint operator+(PlanarPoint a, const PlanarPoint& b);
PlanarPoint operator-(PlanarPoint a, const PlanarPoint& b);

// The vector along u(q_i) + across w(q_i).
PlanarPoint bar(Eigen::Index coordinates, Eigen::Index i, double along, double across = 0);

Eigen::Vector2d position(const PlanarPoint& point, const Eigen::VectorXd& q);
Eigen::Matrix2Xd jacobian(const PlanarPoint& point, const Eigen::VectorXd& q);
// Acceleration of the point for q_ddot = 0.
Eigen::Vector2d convective(const PlanarPoint& point, const Eigen::VectorXd& q,
                           const Eigen::VectorXd& qd);

struct PlanarPart {
  double mass = 0;     // kg
  double inertia = 0;  // kg m^2, about its centre of mass
  PlanarPoint com;
  Eigen::Index angle = -1;  // the coordinate that is the part's angle; -1: none
};

// Mass matrix, and gravity and centrifugal forces of the parts; generalised forces are to be added
// to `force`. `gravity` is the acceleration vector, m/s^2.
TmtSystem assemble(const std::vector<PlanarPart>& parts, const Eigen::Vector2d& gravity,
                   const Eigen::VectorXd& q, const Eigen::VectorXd& qd);

// Velocities of the parts' coordinates (x, z, angle for each part in order) and their masses, with
// which an impact map converts between sets of coordinates.
Eigen::MatrixXd part_jacobian(const std::vector<PlanarPart>& parts, const Eigen::VectorXd& q);
Eigen::VectorXd part_masses(const std::vector<PlanarPart>& parts);

struct PlanarMomentum {
  double mass = 0;                                   // kg
  Eigen::Vector2d com = Eigen::Vector2d::Zero();     // m
  Eigen::Vector2d linear = Eigen::Vector2d::Zero();  // kg m/s
  double angular = 0;  // kg m^2/s about the centre of mass, positive forward (about the y axis)
};
PlanarMomentum momentum(const std::vector<PlanarPart>& parts, const Eigen::VectorXd& q,
                        const Eigen::VectorXd& qd);

struct PlanarEnergy {
  double kinetic = 0;
  double potential = 0;  // zero at the origin
};
PlanarEnergy mechanical_energy(const std::vector<PlanarPart>& parts, const Eigen::Vector2d& gravity,
                               const Eigen::VectorXd& q, const Eigen::VectorXd& qd);

// sum m (a - g): the resultant of all external forces except gravity, i.e. the ground reaction, N.
Eigen::Vector2d outer_force(const std::vector<PlanarPart>& parts, const Eigen::Vector2d& gravity,
                            const Eigen::VectorXd& q, const Eigen::VectorXd& qd,
                            const Eigen::VectorXd& qdd);

}  // namespace mechanics
}  // namespace walktrack
