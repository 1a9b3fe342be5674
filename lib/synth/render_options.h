// What a synthetic recording is made of. Defaults give one side camera in a room.
// Metres, seconds, radians; positions in world axes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "body/motion.h"
#include "core/conventions.h"
#include "synth/sensor.h"
#include "synth/shape.h"
#include "synth/world.h"

namespace walktrack {
inline namespace synth {

// A camera stands where its calibration file says, or at `position` looking at `look_at`, or, by
// default, on a circle about the middle of the walk.
struct RenderCamera {
  std::string name;
  std::filesystem::path calibration;  // OpenCV file; empty = placed by what follows
  int width_px = 640, height_px = 480;
  std::optional<double> focal_px;           // default: 1.05 widths, a field of 51 degrees
  std::vector<double> distortion;           // OpenCV coefficients
  std::optional<Eigen::Vector3d> position;  // with look_at
  std::optional<Eigen::Vector3d> look_at;   // default: the middle of the walk, 0.9 m up
  double azimuth = -0.5 * kPi;     // from the direction of walking; -90 deg sees the right side
  std::optional<double> distance;  // default: the whole walk fits into the picture
  double height = 1.2;
  std::optional<double> frame_rate;  // Hz, default: the scene's
  int start_frame = 0;               // frames that it films before the scene begins (stated)
  double delay = 0;                  // s; it films that much late, and nothing says so
};

struct FilmedWalker {
  Motion motion;
  std::optional<double> height;  // m; default: the one that thighs and shanks belong to
  double mass = 70;
  int clothes = 0;
  Shape shape;
  bool arms = true;             // rendered if the motion has them
  Eigen::Vector2d shift{0, 0};  // after a turn about the world's z axis
  double turn = 0;
  double delay = 0;  // s; the motion's time 0 is the scene's `delay`
};

struct Shutter {
  double open = 0.5;     // share of the frame interval, centred on the frame's time
  int blur_samples = 1;  // instants averaged over it; 1 = no motion blur
};

struct TimeSpan {
  double from = 0, to = 0;  // s of the scene
};

// What is wrong with the keypoints of a video.
struct KeypointFaults {
  double noise = 0.01;              // deviation of a coordinate at full confidence, share of height
  double dropout = 0;               // share of the points that are missing
  double flips = 0;                 // share of the frames in which the legs' names are swapped
  double bias = 0;                  // all points lie higher by that share of the person's height
  std::vector<TimeSpan> flipped{};  // times at which they are swapped in every frame
  std::vector<TimeSpan> missing{};  // times at which only others are seen, not the subject
};

struct RenderOptions {
  uint64_t seed = 1;
  double frame_rate = 30;          // Hz
  double start = 0;                // time of the motion at scene time 0
  std::optional<double> duration;  // default: to the motion's end
  Setting setting = Setting::kRoom;
  Light light;
  double gloss = 0;  // of the ground, see World::gloss
  Sensor sensor;
  Shutter shutter;
  int jpeg_quality = 0;               // 1 (worst) to 100: frames pass a JPEG coder; 0 = they do not
  bool images = false;                // folders of PNG images in place of videos
  int background_frames = 30;         // of the empty scene, a video of its own; 0 = none
  std::vector<RenderCamera> cameras;  // none = one at the side
  std::vector<Thing> occluders;       // that stand in the scene, also in the empty one
  std::vector<FilmedWalker> others;   // further walkers
  double slope = 0;                   // gravity tilts by this angle along the first steps, > 0 down
  bool state_initial = false;         // scene.yaml tells where the walker is at time 0
  std::optional<KeypointFaults> keypoints;           // write keypoint files
  bool labels = false, flow = false, depth = false;  // write them for every frame
};

}  // namespace synth
}  // namespace walktrack
