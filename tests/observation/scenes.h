// Common parts of several tests of this module: random poses and a camera looking at them.
#pragma once

#include <vector>

#include <Eigen/Geometry>

#include "body/body.h"
#include "body/kinematics.h"
#include "camera/camera.h"
#include "core/conventions.h"
#include "core/rng.h"
#include "observation/observation_config.h"
#include "tests/camera/made_camera.h"

namespace walktrack {

inline ObservationConfig every_term() {
  ObservationConfig config;
  config.flow.enabled = TermSetting::kOn;
  return config;
}

inline double draw(Rng& rng, double low, double high) { return low + (high - low) * rng.uniform(); }

// At `eye`, looking at `target`, z up.
inline Camera camera_at(const Eigen::Vector3d& eye, const Eigen::Vector3d& target, double focal_px,
                        int width_px = 640, int height_px = 480) {
  return looking_at(lens({width_px, height_px}, {focal_px, focal_px},
                         {width_px / 2.0 - 0.5, height_px / 2.0 - 0.5}),
                    eye, target);
}

inline Camera side_camera() { return camera_at({0, -6, 1.5}, {0, 0, 0.9}, 672); }

inline Pose random_walking_pose(Rng& rng) {
  Pose pose;
  pose.root = {draw(rng, -1, 1), draw(rng, -1, 1), draw(rng, 0.8, 1.0)};
  pose.heading = draw(rng, -kPi, kPi);
  pose.list = draw(rng, -0.1, 0.1);
  pose.tilt = draw(rng, -0.1, 0.3);
  for (LegPose& leg : pose.legs) {
    leg.hip_flexion = draw(rng, -0.4, 0.7);
    leg.hip_abduction = draw(rng, -0.1, 0.2);
    leg.knee_flexion = draw(rng, 0, 1.2);
    leg.ankle_dorsiflexion = draw(rng, -0.4, 0.3);
  }
  for (ArmPose& arm : pose.arms) arm = {draw(rng, -0.6, 0.8), draw(rng, 0, 0.3), draw(rng, 0, 1.2)};
  return pose;
}

inline PosedParts posed(const Body& body, const Pose& pose) {
  return pose_parts(body, forward_kinematics(body, pose));
}

}  // namespace walktrack
