// Motions of a body whose joints are known exactly, for the laws of mechanics.
#pragma once

#include <cmath>

#include "body/kinematics.h"
#include "body/motion.h"

namespace walktrack {

inline constexpr double kSampleRate = 100;  // Hz

// Joints of a pose of the standard subject; joints that the body does not model are unknown.
inline JointPositions joints_of(const Pose& pose, bool arms = false) {
  const Body body = make_body(Subject{}, {.head = true, .arms = arms});
  JointPositions joints = forward_kinematics(body, pose).joints;
  for (size_t j = kJointCountWithoutArms; !arms && j < kJointCount; ++j)
    joints.at[j].setConstant(NAN);
  return joints;
}

// Standing upright, soles on the ground, the body's centre above the feet.
inline Pose standing() {
  const BodyLengths lengths = body_lengths(Subject{});
  Pose pose;
  pose.root.z() = leg_length(lengths);
  pose.tilt = 0.05;
  for (LegPose& leg : pose.legs) leg.hip_flexion = pose.tilt;  // legs upright
  return pose;
}

// Rows of f(t) for t = 0, 1 / rate, …
template <typename F>
Motion motion_by(F f, int rows = 101) {
  Motion motion;
  for (int i = 0; i < rows; ++i) {
    motion.time.push_back(i / kSampleRate);
    motion.joints.push_back(f(motion.time.back()));
  }
  return motion;
}

// A lively motion: every joint swings, the pelvis moves on all axes.
inline Pose lively(double t) {
  Pose pose = standing();
  pose.root += Eigen::Vector3d(1.2 * t, 0.03 * std::sin(5 * t), 0.02 * std::cos(9 * t));
  pose.heading = 0.2 * std::sin(3 * t);
  pose.list = 0.06 * std::sin(4 * t);
  pose.tilt = 0.1 + 0.05 * std::cos(5 * t);
  for (size_t side = 0; side < 2; ++side) {
    const double phase = 5 * t + (side == 0 ? 0 : 2.5);
    pose.legs[side] = {0.4 * std::sin(phase), 0.05 * std::cos(phase), 0.05 * std::sin(2 * phase),
                       0.4 + 0.3 * std::sin(phase + 1), 0.2 * std::sin(phase + 2)};
    pose.arms[side] = {0.3 * std::sin(phase), 0.1, 0.4 + 0.1 * std::cos(phase)};
  }
  return pose;
}

}  // namespace walktrack
