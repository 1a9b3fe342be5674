// Poses beside the true one, which should have a lower likelihood.
#pragma once

#include <functional>
#include <initializer_list>
#include <vector>

#include <Eigen/Geometry>

#include "body/pose.h"

namespace walktrack {

using Change = std::function<void(JointPositions&)>;

// Rotates joints about another one, in the sagittal plane.
inline void turn(JointPositions& j, std::initializer_list<Joint> which, Joint about, double angle) {
  const Eigen::Vector3d axis = (j[Joint::kLeftHip] - j[Joint::kRightHip]).normalized();
  const Eigen::AngleAxisd rotation(angle, axis);
  const Eigen::Vector3d centre = j[about];
  for (const Joint joint : which) j[joint] = centre + rotation * (j[joint] - centre);
}

inline Change shifted(const Eigen::Vector3d& by) {
  return [by](JointPositions& j) {
    for (Eigen::Vector3d& p : j.at) p += by;
  };
}

// The pose moved along and up by `shift` (m), or one limb turned by `angle` (rad), both ways.
inline std::vector<Change> changes(double shift, double angle) {
  std::vector<Change> out;
  for (const double s : {-1.0, 1.0}) {
    const double a = s * angle;
    out.push_back(shifted({shift * s, 0, 0}));
    out.push_back(shifted({0, 0, shift * s}));
    out.push_back([a](JointPositions& j) {
      turn(j, {Joint::kNeck, Joint::kHead}, Joint::kPelvis, a);
    });
    for (const Side side : {Side::kLeft, Side::kRight}) {
      out.push_back([a, side](JointPositions& j) {
        turn(j, {knee(side), ankle(side), toe(side)}, hip(side), a);
      });
      out.push_back([a, side](JointPositions& j) {
        turn(j, {ankle(side), toe(side)}, knee(side), a);
      });
    }
  }
  return out;
}

struct Share {
  int won = 0, asked = 0;
  double value() const { return won / static_cast<double>(asked); }
};

}  // namespace walktrack
