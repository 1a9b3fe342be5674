// Simbody behind an interface of plain numbers: its headers do not compile as C++20, so that the
// tests use this one. No walktrack header is included here.
#pragma once

#include <vector>

#include <Eigen/Core>

namespace simbody {

enum class Joint { kFree, kPin, kBall, kWeld };

struct Part {
  double mass = 0;
  Eigen::Vector3d com;      // in the part's frame, whose origin is the joint
  Eigen::Matrix3d inertia;  // about the frame's origin
  int parent = -1;          // -1: the ground
  Joint joint = Joint::kFree;
  Eigen::Vector3d anchor;  // in the parent's frame
  Eigen::Matrix3d rest;    // parent_from_part at zero
  Eigen::Vector3d axis;    // of a pin, part's frame
};

// World axes; velocity, acceleration and force at the part's origin.
struct Motion {
  Eigen::Matrix3d rotation;
  Eigen::Vector3d origin, omega, velocity;
};
struct Load {
  Eigen::Vector3d torque, force;
};
struct Acceleration {
  Eigen::Vector3d alpha, linear;
};

// Accelerations of all parts, each with its load.
std::vector<Acceleration> accelerations(const std::vector<Part>& parts,
                                        const std::vector<Motion>& motions,
                                        const std::vector<Load>& loads);

// A planar chain of pins about the y axis whose first part rolls on the ground z = 0 by a wheel of
// radius `wheel_radius` around its origin (0: pinned to the ground). `angles` are absolute,
// positive about y; returns their second derivatives with gravity (x, z) and torques on the parts.
std::vector<double> rolling_chain(const std::vector<Part>& parts, double wheel_radius,
                                  const std::vector<double>& angles,
                                  const std::vector<double>& rates, double gravity_x,
                                  double gravity_z, const std::vector<double>& torques);

}  // namespace simbody
