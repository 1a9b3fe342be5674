// The configuration: how to track. It gathers the config structs of the modules; each struct owns
// its defaults, and config_table.cpp holds the one table that gives its members names and ranges.
//
// Files are YAML and list only what differs:
//   seed: 7
//   filter: {particles: 5000}
// Errors are UsageErrors "file:line: key: found X, allowed Y"; unknown keys name the nearest one.
#pragma once

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

// A result that fails one of these ends in exit code 4.
struct QualityConfig {
  double lost_share = 0.1;          // of the frames after the walker was found
  double untracked_movement = 0.3;  // of the frames in which somebody moves
  double least_steps = 1;           // foot changes seen; who makes none does not walk
  double overlap = 0.55;            // of figure and foreground, mean of the worst camera
  double better_beside = 0.005;     // of the evidence, mean over frames (tracker/figure_fit.h)
  double on_detected = 0.6;    // of the frames with keypoints: the figure is a person of theirs
  double legs_swapped = 0.5;   // mean probability
  double leg_swaps = 10;       // a minute
  double steps_off_way = 0.2;  // of the pelvis' way, by which the steps miss it
  double longest_step = 1.2;   // leg lengths
  double shortest_step = 0;    // m along the way; below 0 a foot ends behind the other
  double quickest_step = 0.5;  // of the usual time of a step
  double fastest = 2.5;        // m/s over half a second
  double foot_slide = 0.08;    // m, mean over stances, before feet are planted
  double penetration = 0.1;    // m
  double jitter = 500;         // m/s^3
};

// Particles that follow the clock, so that frames keep to a time. What comes out then depends on
// the machine's speed and load: it is the one thing in the configuration that makes results differ
// from run to run.
struct BudgetConfig {
  double frame_ms = 0;        // for a frame, from decoding to the estimate; 0 = none
  int least_particles = 50;   // never fewer, even if frames take longer
  int most_particles = 2000;  // never more
};

// The videos with the tracked figure in them.
struct OverlayConfig {
  int width = 1280;   // px at most; 0 = as the video
  bool crop = false;  // to a window that follows the walker
  EncoderPreset preset = EncoderPreset::kSuperfast;
};

// The page to look at.
struct ReportConfig {
  double embed_mb = 24;  // of overlay videos inside it; larger ones are played from beside it
};

// When `track` notes where it stands (io/archive/checkpoint_file.h).
struct CheckpointConfig {
  double seconds = 10;  // between checkpoints, or as long as keeps their cost small; 0: each frame
};

struct Config {
  uint64_t seed = 1;  // of all random numbers
  int threads = 0;    // 0 = all that the process may use
  BodyGroups body;
  ObservationConfig observation;
  TrackerConfig tracker;
  SmoothingConfig smoothing;
  KineticsConfig kinetics;
  QualityConfig quality;
  BudgetConfig budget;
  OverlayConfig overlay;
  ReportConfig report;
  CheckpointConfig checkpoint;
};

// A configuration and where each value that is no default came from.
struct ConfigWithOrigin {
  Config values;
  std::map<std::string, std::string> origin;  // key -> "fast.yaml:3" or "--set"
  std::vector<std::string> renamed;           // a message for each key given by its old name
};

// The values of a file on top of `config`. Where there is no such file, `path` may be the name of a
// preset (io/config/presets.h).
void apply_config_file(ConfigWithOrigin& config, const std::string& path);

// "key=value" on top of `config`; `origin` is what messages and printouts call it, e.g. "--set".
void apply_setting(ConfigWithOrigin& config, const std::string& setting, const std::string& origin);

// As YAML that apply_config_file reads back to the same values: every parameter, or only those that
// are no defaults; with a comment of meaning, allowed values and origin, or bare.
enum class ConfigScope { kEverything, kChanged };
std::string config_as_yaml(const ConfigWithOrigin& config, ConfigScope scope, bool comments);

// Every key and its effective value as text, in table order: what run.json keeps.
std::vector<std::pair<std::string, std::string>> config_values(const Config& config);

}  // namespace io
}  // namespace walktrack
