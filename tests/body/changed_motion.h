// A motion with each of its rows changed, to plant faults of trackers.
#pragma once

#include <utility>

#include "body/motion.h"

namespace walktrack {

// The same motion with f(joints, row) applied to each row.
template <typename F>
Motion changed(Motion motion, F f) {
  for (size_t i = 0; i < motion.joints.size(); ++i) f(motion.joints[i], i);
  return motion;
}

inline void mirror_legs(JointPositions& joints) {
  for (const auto& of : {hip, knee, ankle, toe})
    std::swap(joints[of(Side::kLeft)], joints[of(Side::kRight)]);
}

// The knees on the other side of the line from hip to ankle: flexion with the wrong sign.
inline void flip_knees(JointPositions& joints) {
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const Eigen::Vector3d line = (joints[ankle(side)] - joints[hip(side)]).normalized();
    const Eigen::Vector3d out = joints[knee(side)] - joints[hip(side)];
    joints[knee(side)] = joints[hip(side)] + 2 * line * line.dot(out) - out;
  }
}

}  // namespace walktrack
