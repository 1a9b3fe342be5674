// A walk of known numbers, shared by the tests of this folder: the pelvis moves at constant speed,
// each foot is at rest for a known share of the stride and swings in between.
#pragma once

#include <cmath>

#include <Eigen/Geometry>

#include "body/motion.h"
#include "tests/body/changed_motion.h"

namespace walktrack {

struct TestWalk {
  double speed = 1.2, step_time = 0.55, stance_share = 0.6, step_width = 0.12;
  double heading = 0, rate = 30, duration = 5;
  double phase = 0;  // strides before time 0
};

// x and z of a foot `cycle` strides after one of its strikes, and the strike's time relative to the
// pelvis: x relative to that strike's place, in strides.
inline Eigen::Vector2d swing(double cycle, double stance_share) {
  const double whole = std::floor(cycle), u = (cycle - whole - stance_share) / (1 - stance_share);
  if (u <= 0) return {whole, 0};
  return {whole + u * u * (3 - 2 * u), 0.4 * u * (1 - u)};
}

// The left foot strikes at strides 0, 1, …, the right one half a stride later. A supporting foot is
// below the pelvis at the middle of its stance.
inline JointPositions walk_joints(const TestWalk& walk, double time) {
  const double stride_time = 2 * walk.step_time, stride = walk.speed * stride_time;
  JointPositions joints = unknown_joints();
  const double pelvis = walk.speed * time;
  joints[Joint::kPelvis] = {pelvis, 0, 0.9};
  joints[Joint::kNeck] = {pelvis, 0, 1.45};
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const double y = (side == Side::kLeft ? 0.5 : -0.5) * walk.step_width;
    const double lag = side == Side::kLeft ? 0 : 0.5;
    const Eigen::Vector2d foot = swing(time / stride_time + walk.phase - lag, walk.stance_share);
    const double x = (foot.x() - walk.phase + lag + walk.stance_share / 2) * stride;
    joints[hip(side)] = {pelvis, y, 0.9};
    joints[ankle(side)] = {x - 0.08, y, 0.08 + foot.y()};
    joints[toe(side)] = {x + 0.08, y, 0.02 + foot.y()};
    const Eigen::Vector3d middle = 0.5 * (joints[hip(side)] + joints[ankle(side)]);
    joints[knee(side)] = middle + Eigen::Vector3d(0.08, 0, 0);
  }
  const Eigen::AngleAxisd turn(walk.heading, Eigen::Vector3d::UnitZ());
  for (Eigen::Vector3d& joint : joints.at) joint = turn * joint;
  return joints;
}

inline Motion walk_motion(const TestWalk& walk) {
  Motion motion;
  const int rows = static_cast<int>(walk.duration * walk.rate);
  for (int i = 0; i < rows; ++i) {
    motion.time.push_back(i / walk.rate);
    motion.joints.push_back(walk_joints(walk, motion.time.back()));
  }
  return motion;
}

}  // namespace walktrack
