// Videos of the self-test: a generated walk is rendered in memory, degraded as the trial demands,
// written as a scene folder and tracked in the same way as by `walktrack track`.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "body/motion.h"
#include "jobs/selftest/selftest_trials.h"
#include "observation/image.h"
#include "synth/recording/render_options.h"
#include "synth/walk/made_walk.h"

namespace walktrack {
inline namespace jobs {

using Frames = std::vector<Image>;

struct TestVideo {
  FilmedWalker walker;                   // the person in the video
  RenderOptions options;                 // one camera, of which only size, rate and slope matter
  int enlarge = 1;                       // factor of frames and focal length after rendering
  std::function<void(Frames&)> degrade;  // degrades the frames afterwards
  bool state_initial = true;             // whether the scene states where the walk begins
  std::string scene_lines;               // further lines of scene.yaml
  std::vector<std::string> settings;     // of the configuration, key=value
  bool watch_memory = false;             // fails if the memory of tracking grows with the frames
};

// A walk of two seconds across the image of a camera with 160 x 120 pixels at the side.
TestVideo video_of_walk(double speed = 1.25);

// The same walk of a larger or smaller person, dynamically similar: lengths, including the position
// of the camera, are multiplied by k and times by the square root of k, because gravity is the
// same. The images do not change.
TestVideo video_of_body(double height);

// The standing pose, with feet together and knees straight, moved along x and turned about z.
TestVideo video_of_standing(double speed, double turn_rate);

// Renders, writes `folder`, tracks, and judges the result.
TrialResult try_video(const TestVideo& video, const std::filesystem::path& folder);

}  // namespace jobs
}  // namespace walktrack
