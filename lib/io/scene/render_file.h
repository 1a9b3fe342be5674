// The YAML file of `walktrack render --options`: strict, as scene.yaml is. Keys mirror
// synth/recording/render_options.h, angles are in degrees there:
//   frame_rate: 30
//   duration: 4
//   setting: room                # room, field, studio
//   light: {azimuth_deg: -60, elevation_deg: 50, sun: 0.55, ambient: 0.45, shadows: true,
//           contact_shadows: false}
//   gloss: 0                     # of the floor, 0 matt to 1 polished
//   sensor: {exposure: 1, noise: 0.01, flicker: 0, monochrome: false, blur_samples: 1,
//            shutter: 0.5, jpeg_quality: 0}
//   walk: {speed: 1.25, step_length: 0.7, start: [0, 0], heading_deg: 0, turn_deg_s: 0, phase: 0,
//          arm_swing: 1, limp: 0, step_width: 0.09, lean_deg: 4, straightest: 0.999, person: 7}
//                  # where there is no MOTION.csv (synth/walk/made_walk.h): steps,
//                  # knees, trunk, ... are those of a person, by default that of the seed's
//                  # number; 0 is the average one
//   gait: {speed: 1.3, step_length: 0.7, start: [0, 0], heading_deg: 0, speed_at: [[2, 1.6]]}
//                  # or this: the kneed walker by the table of gaits, whose truth has forces
//   subject: {height: 1.75, mass: 70, clothes: 0, arms: true}   # height: else as the legs have it
//             lengths: {thigh: 0.45, shank: 0.45, hip_width: 0.18, trunk: 0.5}  # m, of a `walk`
//             shape: {girth: 1, head: 1, belly: 0, trousers: 0, skirt: 0, pack: 0}
//                  # shape: synth/world/shape.h
//   cameras:
//     - {name: side, azimuth_deg: -90, distance: 5, height: 1.2, size: [640, 480], focal_px: 600,
//        distortion: [-0.1, 0.02]}
//     - {name: lab, calibration: lab.yaml, frame_rate: 25, start_frame: 3, delay: 0.01}
//   occluders: [{post: [x, y, radius, height]}, {box: [x0, y0, z0, x1, y1, z1]}]
//   others: [{motion: other.csv, shift: [0, 1.5], turn_deg: 180, delay: 0.5, clothes: 2},
//            {walk: {speed: 1, start: [3, 1], heading_deg: 180}}]
//   images: false                # folders of PNG images in place of videos
//   keypoints: {noise: 0.01, dropout: 0.02, flips: 0.01, bias: 0, flipped: [[1, 1.3]],
//               missing: [[2, 3]]}   # a detector's files as well, with these faults
//   truth: {labels: false, flow: false, depth: false}
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "gait/walk_plan.h"
#include "synth/recording/render_options.h"

namespace walktrack {
inline namespace io {

// A walk that is simulated by the kneed walker.
struct GaitWalk {
  WalkPlan plan;
  Eigen::Vector2d start{0, 0};  // m, below the hips at time 0
  double heading = 0;           // rad, from world x towards y
};

inline constexpr double kDefaultWalkDuration = 4;  // s, of a `walk` or `gait`

struct RenderFile {
  RenderOptions options;
  FilmedWalker subject;  // its motion is empty if there is no `walk`
  std::optional<GaitWalk> gait;
  std::vector<std::filesystem::path> motions;  // files of other people's motions that were read
};

// Paths in it are relative to the file; the motions of other people are read. InputErrors name
// file, line and key.
RenderFile read_render_file(const std::filesystem::path& path);

}  // namespace io
}  // namespace walktrack
