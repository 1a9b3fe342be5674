// The options of a synthetic recording. Defaults give one side camera in a room. Metres, seconds,
// radians; positions in world axes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "body/motion.h"
#include "core/conventions.h"
#include "synth/recording/sensor.h"
#include "synth/world/settings.h"
#include "synth/world/shape.h"

namespace walktrack {
inline namespace synth {

// The pose of a camera is that in its calibration file, or `position` looking at `look_at`, or, by
// default, a place on a circle around the middle of the walk.
struct RenderCamera {
  std::string name;
  std::filesystem::path calibration;  // OpenCV file; empty = the members below
  int width_px = 640, height_px = 480;
  std::optional<double> focal_px;           // default: 1.05 widths, a field of 51 degrees
  std::vector<double> distortion;           // OpenCV coefficients
  std::optional<Eigen::Vector3d> position;  // with look_at
  std::optional<Eigen::Vector3d> look_at;   // default: the middle of the walk, 0.9 m up
  double azimuth = -0.5 * kPi;     // from the direction of walking; -90 deg sees the right side
  std::optional<double> distance;  // default: the whole walk is in the image
  double height = 1.2;
  std::optional<double> frame_rate;  // Hz, default: the scene's
  int start_frame = 0;               // number of frames before the scene begins (stated)
  double delay = 0;                  // s; lag of the recording that the scene does not state
};

struct FilmedWalker {
  Motion motion;
  std::optional<double> height;  // m; default: from the lengths of thighs and shanks
  double mass = 70;
  int clothes = 0;
  Shape shape;
  bool arms = true;             // rendered if the motion has arms
  Eigen::Vector2d shift{0, 0};  // after a rotation about the world's z axis
  double turn = 0;
  double delay = 0;  // s; the motion's time 0 is the scene's `delay`
};

struct Shutter {
  double open = 0.5;     // share of the frame interval, centred on the frame's time
  int blur_samples = 1;  // samples that are averaged over it; 1 = no motion blur
};

struct TimeSpan {
  double from = 0, to = 0;  // s of the scene
};

// Errors of rendered keypoints.
struct KeypointFaults {
  double noise = 0.01;              // standard deviation of a coordinate at full confidence, share
                                    // of height
  double dropout = 0;               // share of the points that are missing
  double flips = 0;                 // share of the frames in which the legs' labels are swapped
  double bias = 0;                  // all points are shifted upwards by this share of the person's
                                    // height
  std::vector<TimeSpan> flipped{};  // times at which they are swapped in every frame
  std::vector<TimeSpan> missing{};  // times at which only other people are detected, not the
                                    // subject
};

struct RenderOptions {
  uint64_t seed = 1;
  double frame_rate = 30;          // Hz
  double start = 0;                // time of the motion at scene time 0
  std::optional<double> duration;  // default: to the end of the motion
  Setting setting = Setting::kRoom;
  Light light;
  double gloss = 0;  // of the ground, see World::gloss
  Sensor sensor;
  Shutter shutter;
  int jpeg_quality = 0;               // 1 (worst) to 100: JPEG compression of frames; 0 = none
  bool images = false;                // folders of PNG images in place of videos
  int background_frames = 30;         // of the empty scene, a video of its own; 0 = none
  std::vector<RenderCamera> cameras;  // empty = one at the side
  std::vector<Thing> occluders;       // objects in the scene and in the empty scene
  std::vector<FilmedWalker> others;   // other people
  double slope = 0;                   // tilt of gravity along the first steps, > 0 down
  bool state_initial = false;         // scene.yaml states the walker's state at time 0
  std::optional<KeypointFaults> keypoints;           // write keypoint files with these errors
  bool labels = false, flow = false, depth = false;  // write these for every frame
};

}  // namespace synth
}  // namespace walktrack
