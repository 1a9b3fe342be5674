// Mass, centre of mass and inertia of solids of uniform density, in closed form:
//   m = int rho,   c = int rho r / m,   I = int rho (|r|^2 E - r r^T) about c.
// Lengths in metres, density in kg/m^3. Every solid has a frame of its own; `transformed` moves it,
// `combined` joins solids. Negative sizes are errors of the caller (std::invalid_argument).
#pragma once

#include <span>

#include <Eigen/Core>

namespace walktrack {
inline namespace mechanics {

struct MassProperties {
  double mass = 0;                                    // kg
  Eigen::Vector3d com = Eigen::Vector3d::Zero();      // m, in the frame of the solid
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  // kg m^2, about com, axes of the frame
};

// Ellipsoid about the origin, semi-axes along x, y, z.
MassProperties ellipsoid(double density, const Eigen::Vector3d& semi_axes);

// Truncated cone along z from 0 to `length` with elliptic sections whose semi-axes (x, y) change
// linearly from `base` to `top`. Equal base and top give a cylinder, a zero top gives a full cone.
MassProperties elliptic_frustum(double density, double length, const Eigen::Vector2d& base,
                                const Eigen::Vector2d& top);

// Circular cylinder of `length` along z from 0, with a half sphere at either end.
MassProperties capsule(double density, double length, double radius);

// The same solid in a frame with x_new = rotation * x_old + translation.
MassProperties transformed(const MassProperties& solid, const Eigen::Matrix3d& rotation,
                           const Eigen::Vector3d& translation);

// One rigid body of several solids in one frame (parallel axis theorem). The centre of mass of
// massless solids is the origin.
MassProperties combined(std::span<const MassProperties> solids);

// Inertia about another point of the same frame.
Eigen::Matrix3d inertia_about(const MassProperties& solid, const Eigen::Vector3d& point);

}  // namespace mechanics
}  // namespace walktrack
