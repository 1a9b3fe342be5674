// Model files of `simulate` and `cycle`: which walker, its parameters, controls and start.
//   model: anthropomorphic
//   parameters: {slope: 0.01}
//   controls: {toe_off_impulse: 0}
//   start: {q: [-0.2577, 0.2577], qd: [0.2686, 0.2199]}
// What is left out keeps the model's default. Errors are UsageErrors "file:line: key: found X,
// allowed Y"; unknown keys name the nearest one.
#pragma once

#include <string>
#include <vector>

#include "walker/model_spec.h"

namespace walktrack {
inline namespace io {

// One value by its dotted key, with where it stands for messages.
struct ModelSetting {
  std::string file;
  int line = 0;
  std::string key, text;
};

// The values of a file; "model" is one of them.
std::vector<ModelSetting> read_model_settings(const std::string& path);

// The name that --model or the file gives. UsageError where they differ or neither gives one.
std::string model_name(const std::string& name, const std::string& file);

// The values of a file, then "key=value" settings, into `entries`; "model" is passed over.
void apply_model_settings(const std::vector<ModelEntry>& entries, const std::string& file,
                          const std::vector<std::string>& settings);

// The model that `name`, a file and "key=value" settings describe, each on top of the one before;
// an empty name takes the file's. In settings "parameters." may be left out.
ModelSpec read_model(const std::string& name, const std::string& file,
                     const std::vector<std::string>& settings);

// "key=value" on top of a model.
void apply_model_setting(ModelSpec& spec, const std::string& setting);

// A model as a file that reads back to the same values.
std::string model_as_yaml(const ModelSpec& spec);

}  // namespace io
}  // namespace walktrack
