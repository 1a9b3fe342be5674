// Angles of the left leg over one stride of a generated walk.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "body/pose_from_joints.h"
#include "core/conventions.h"
#include "synth/walk/made_walk.h"

namespace walktrack {

inline constexpr size_t kWholeStride = 101;  // 0 %, 1 %, ..., 100 %, from strike to strike

struct WalkedCurves {
  std::array<double, kWholeStride> hip, knee, ankle;  // degrees
  std::array<double, kWholeStride> height;            // of the pelvis, m
};

// `walk` from phase 0, with the preferred step of the average person.
inline WalkedCurves walked_curves(const Body& body, MadeWalk walk) {
  const double step = 0.40 * body.subject.height * std::pow(walk.speed / 1.25, 0.42);
  walk.step_length = walk.step_length.value_or(step);
  const double stride = 2 * *walk.step_length / walk.speed;
  walk.from = walk.phase = 0;
  walk.to = stride;
  walk.rate = 100 / stride;
  const Motion motion = made_walk(body, walk);
  WalkedCurves out{};
  for (size_t i = 0; i < kWholeStride; ++i) {
    const LegPose leg = pose_from_joints(motion.joints.at(i), body.lengths)->legs[0];
    out.hip[i] = deg_from_rad(leg.hip_flexion);
    out.knee[i] = deg_from_rad(leg.knee_flexion);
    out.ankle[i] = deg_from_rad(leg.ankle_dorsiflexion);
    out.height[i] = motion.joints[i][Joint::kPelvis].z();
  }
  return out;
}

struct Extreme {
  size_t at;  // % of the stride
  double value;
};

inline Extreme most(const std::array<double, kWholeStride>& curve, size_t from, size_t to) {
  const auto found = std::max_element(curve.begin() + from, curve.begin() + to + 1);
  return {static_cast<size_t>(found - curve.begin()), *found};
}

inline Extreme least(const std::array<double, kWholeStride>& curve, size_t from, size_t to) {
  const auto found = std::min_element(curve.begin() + from, curve.begin() + to + 1);
  return {static_cast<size_t>(found - curve.begin()), *found};
}

}  // namespace walktrack
