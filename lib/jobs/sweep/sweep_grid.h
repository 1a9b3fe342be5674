// The grid of a sweep: the parameters that are varied, their values, and the scene and
// configuration for each combination.
//
//   particles=50:100:300      filter.particles           scale=60:120     observation.person_px
//   moves, layers, arms       filter.moves, filter.max_layers, body.arms
//   model=markov:kneed        motion.model          path=sagittal:spatial  motion.path
//   keypoints=off:on          observation.keypoints.enabled
//   terms=all:background+flow   the likelihood terms that are on, by their switches
//   cameras=1:2:side+front      the first so many of the scene, or those named
//   config=fast:balanced:mine.yaml   what -c takes; the other parameters come on top of it
//   any key of `walktrack config`
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "io/config/config.h"
#include "io/scene/scene.h"

namespace walktrack {
inline namespace jobs {

struct SweptParameter {
  std::string name;                 // as it was stated
  std::vector<std::string> values;  // at least one
};

// A value for each parameter, in their order.
using SweepSetting = std::vector<std::string>;

// Parses parameters "NAME=V1:V2,NAME=V1:V2". UsageError for names that are unknown or repeated, and
// for values that this scene or configuration refuses.
std::vector<SweptParameter> swept_parameters(const std::vector<std::string>& words,
                                             const Scene& scene, const ConfigWithOrigin& config);

// All combinations; the last parameter varies fastest.
std::vector<SweepSetting> sweep_grid(const std::vector<SweptParameter>& parameters);

// For each parameter the value that is expected to be the most accurate: the largest number, most
// cameras, most terms, true before false; the last one for other words.
SweepSetting richest_setting(const std::vector<SweptParameter>& parameters);

void apply_sweep_setting(const std::vector<SweptParameter>& parameters, const SweepSetting& setting,
                         Scene& scene, ConfigWithOrigin& config);

// "particles=50 scale=80".
std::string setting_name(const std::vector<SweptParameter>& parameters,
                         const SweepSetting& setting);

// The inputs of `track` for a setting.
struct SettingWords {
  std::string config;                                           // file or preset; empty = none
  std::vector<std::pair<std::string, std::string>> parameters;  // key, value
  std::string cameras;                                          // that are kept in the scene; empty
                                                                // = all
};
SettingWords setting_words(const std::vector<SweptParameter>& parameters,
                           const SweepSetting& setting);

}  // namespace jobs
}  // namespace walktrack
