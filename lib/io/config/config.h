// The configuration of tracking. It contains the config structs of the modules; each struct owns
// its defaults, and the table in config_table.cpp gives its members names and ranges.
//
// Files are YAML and list only what differs:
//   seed: 7
//   filter: {particles: 5000}
// Errors are UsageErrors "file:line: key: found X, allowed Y"; unknown keys name the nearest one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "body/body.h"
#include "io/video/encoder_preset.h"
#include "kinetics/kinetics.h"
#include "observation/observation_config.h"
#include "tracker/smooth/trajectory.h"
#include "tracker/tracker_config.h"

namespace walktrack {
inline namespace io {

// The value of the limit of sliding feet that leaves it to the number of cameras.
inline constexpr double kSlideByCameras = 0;
// That limit, m. With one camera it tells wrong results, above all of walks towards the camera.
// With several it told none of those that were measured, and right ones slide further (report "Are
// green results right?").
inline constexpr double allowed_slide(size_t cameras) { return cameras > 1 ? 0.1 : 0.07; }

// The quality checks. A result that fails one of them leads to exit code 4.
struct QualityConfig {
  double lost_share = 0.1;           // of the frames after the subject was found
  double untracked_movement = 0.3;   // of the frames with motion
  double frame_rate = 5;             // Hz; four frames of a fast walker's stride of .8 s
  double least_steps = 1;            // foot changes; without any the subject does not walk
  double overlap = 0.55;             // of figure and foreground, mean over the frames of the worst
                                     // camera
  double better_beside_nats = 0.25;  // a picture, mean over frames (tracker/figure_fit.h)
  double on_detected = 0.6;    // of the frames with keypoints: the figure agrees with a detected
                               // person
  double legs_swapped = 0.2;   // mean probability
  double leg_swaps = 10;       // a minute
  double steps_off_way = 0.2;  // of the pelvis' way, by which the steps deviate from it
  double missing_steps = 1;    // on the way of the pelvis
  double longest_step = 1.2;   // leg lengths
  double shortest_step = 0;    // m along the way; negative if a foot lands behind the other
  double quickest_step = 0.5;  // of the usual time of a step
  double fastest = 2.5;        // m/s over half a second
  double foot_slide = kSlideByCameras;  // m along the walk, mean over stances, before feet are
                                        // planted
  double penetration = 0.1;             // m
  double jitter = 500;                  // m/s^3
};

// Adapts the number of particles to a time limit for each frame. The results then depend on the
// machine's speed and load; this is the only part of the configuration for which they differ from
// run to run.
struct BudgetConfig {
  double frame_ms = 0;        // time limit for a frame, from decoding to the estimate; 0 = none
  int least_particles = 50;   // lower limit, even if frames take longer
  int most_particles = 2000;  // upper limit
};

// The videos in which the tracked figure is drawn.
struct OverlayConfig {
  int width = 1280;   // px at most; 0 = width of the video
  bool crop = false;  // to a window that follows the subject
  EncoderPreset preset = EncoderPreset::kSuperfast;
};

// The report page.
struct ReportConfig {
  double embed_mb = 24;  // size of overlay videos inside the page; larger ones stay separate files
};

// When `track` writes checkpoints (io/archive/checkpoint_file.h).
struct CheckpointConfig {
  double seconds = 10;  // between checkpoints, or longer if they would cost too much; 0: each frame
};

// The value of a number of particles that leaves it to the number of cameras (particles_for()).
inline constexpr int kParticlesByCameras = 0;
inline TrackerConfig particles_by_cameras() {
  TrackerConfig out;
  out.filter.particles = out.start.particles = kParticlesByCameras;
  return out;
}

// The value of a weight that leaves it to the cameras and terms of a scene (weights_for()).
inline constexpr double kWeightByScene = 0;
inline ObservationConfig weights_by_scene() {
  ObservationConfig out;
  out.outline_share = out.keypoints.weight = out.keypoints.flip = kWeightByScene;
  return out;
}

struct Config {
  uint64_t seed = 1;  // of all random numbers
  int threads = 0;    // 0 = all that the process may use
  BodyGroups body;
  ObservationConfig observation = weights_by_scene();
  TrackerConfig tracker = particles_by_cameras();
  SmoothingConfig smoothing;
  KineticsConfig kinetics;
  QualityConfig quality;
  BudgetConfig budget;
  OverlayConfig overlay;
  ReportConfig report;
  CheckpointConfig checkpoint;
};

// A configuration, and where each value that differs from its default was set.
struct ConfigWithOrigin {
  Config values;
  std::map<std::string, std::string> origin;  // key -> "fast.yaml:3" or "--set"
  std::vector<std::string> renamed;           // a message for each key given by its old name
};

// Applies the values of a file to `config`. If there is no such file, `path` may be the name of a
// preset (io/config/presets.h).
void apply_config_file(ConfigWithOrigin& config, const std::string& path);

// Applies "key=value" to `config`; `origin` is its name in messages, e.g. "--set".
void apply_setting(ConfigWithOrigin& config, const std::string& setting, const std::string& origin);

// The configuration as YAML that apply_config_file reads back to the same values: every parameter,
// or only those that differ from their defaults; with comments on meaning, allowed values and
// origin, or without.
enum class ConfigScope { kEverything, kChanged };
std::string config_as_yaml(const ConfigWithOrigin& config, ConfigScope scope, bool comments);

// Every key and its effective value as text, in the order of the table, for run.json.
std::vector<std::pair<std::string, std::string>> config_values(const Config& config);

}  // namespace io
}  // namespace walktrack
