// Exact intersections of rays with the solids of the world.
//
// A cone solid is a body part (body/body.h): with e = upper - lower, the points
//   lower + s e + x forward + y lateral,   (x / a(s))^2 + (y / b(s))^2 <= 1,
//   a(s) = (1 - s) a0 + s a1, b(s) likewise, 0 <= s <= 1,
// and half an ellipsoid beyond either end whose third semi-axis, along e, is the mean of that end's
// a and b. In the oblique coordinates (x, y, s) a ray is a straight line, so that it intersects the
// side at the roots of a quartic and the ends at those of quadratics. Metres, world axes.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "body/kinematics.h"
#include "camera/camera.h"

namespace walktrack {
inline namespace synth {

struct ConeSolid {
  Eigen::Vector3d lower;
  Eigen::Matrix3d world_from_local;  // columns forward, lateral, e
  Eigen::Matrix3d local_from_world;
  double a0, a1, b0, b1;   // m
  double cap0, cap1;       // third semi-axes of the ends, in units of s
  double length;           // m, of e
  Eigen::Vector3d middle;  // of the bounding sphere
  double radius;           // m, of the bounding sphere
};

ConeSolid cone_solid(const PosedPart& part);

// (x, y, s) of a point, and back.
Eigen::Vector3d local_point(const ConeSolid& solid, const Eigen::Vector3d& world);
Eigen::Vector3d world_point(const ConeSolid& solid, const Eigen::Vector3d& local);

// Distance along the ray (> 0) to its entry into the solid, if that is nearer than `farthest`.
std::optional<double> entry_distance(const ConeSolid& solid, const Ray& ray, double farthest);

// Outward unit normal at a point of the surface given in local coordinates.
Eigen::Vector3d surface_normal(const ConeSolid& solid, const Eigen::Vector3d& local);

// A box with sides along the world's axes.
struct BoxSolid {
  Eigen::Vector3d low, high;
};

std::optional<double> entry_distance(const BoxSolid& box, const Ray& ray, double farthest);

Eigen::Vector3d surface_normal(const BoxSolid& box, const Eigen::Vector3d& point);

}  // namespace synth
}  // namespace walktrack
