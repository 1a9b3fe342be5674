// Videos of the self-test: a made walk rendered in memory, spoilt as a trial wants, written as a
// scene folder and tracked as `walktrack track` does.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "body/motion.h"
#include "jobs/selftest/selftest.h"
#include "synth/made_walk.h"
#include "synth/render_options.h"

namespace walktrack {
inline namespace jobs {

using Frames = std::vector<cv::Mat>;

struct TestVideo {
  FilmedWalker walker;                 // whom it shows
  RenderOptions options;               // one camera; its size, rate and slope matter
  int enlarge = 1;                     // frames and focal length times this, after rendering
  std::function<void(Frames&)> spoil;  // what happens to the frames then
  bool state_initial = true;           // whether the scene says where the walk begins
  std::string scene_lines;             // more of scene.yaml
  std::vector<std::string> settings;   // of the configuration, key=value
  bool watch_memory = false;           // fails if tracking takes more of it from frame to frame
};

// A walk of two seconds across the picture of a camera of 160 x 120 pixels at the side.
TestVideo video_of_walk(double speed = 1.25);

// The same walk of somebody larger or smaller, dynamically similar: lengths, the camera's place
// among them, times k and times times the square root of k, as gravity is what it is. The picture
// stays.
TestVideo video_of_body(double height);

// The standing pose, feet together and knees straight, moved along x and turned about z.
TestVideo video_of_standing(double speed, double turn_rate);

// Renders, writes `folder`, tracks, and judges the result.
TrialResult try_video(const TestVideo& video, const std::filesystem::path& folder);

}  // namespace jobs
}  // namespace walktrack
