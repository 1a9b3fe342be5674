// Model files of `simulate` and `cycle`: which walker, its parameters, controls and start.
//   model: anthropomorphic
//   parameters: {slope: 0.01}
//   controls: {toe_off_impulse: 0}
//   start: {q: [-0.2577, 0.2577], qd: [0.2686, 0.2199]}
// Missing keys keep the model's defaults. Errors are UsageErrors "file:line: key: found X, allowed
// Y"; for an unknown key they name the nearest one.
#pragma once

#include <string>
#include <vector>

#include "walker/model_spec.h"

namespace walktrack {
inline namespace io {

// One value with its dotted key and its place for messages.
struct ModelSetting {
  std::string file;
  int line = 0;
  std::string key, text;
};

// The values of a file; "model" is one of them.
std::vector<ModelSetting> read_model_settings(const std::string& path);

// The name that --model or the file states. UsageError if they differ or neither states one.
std::string model_name(const std::string& name, const std::string& file);

// Appends the values of a file, then "key=value" settings, to `entries`; "model" is skipped.
void apply_model_settings(const std::vector<ModelEntry>& entries, const std::string& file,
                          const std::vector<std::string>& settings);

// The model that `name`, a file and "key=value" settings describe, each applied after the one
// before; an empty name stands for the file's. In settings "parameters." may be left out.
ModelSpec read_model(const std::string& name, const std::string& file,
                     const std::vector<std::string>& settings);

// Applies "key=value" to a model.
void apply_model_setting(ModelSpec& spec, const std::string& setting);

// A model as a file that reads back to the same values.
std::string model_as_yaml(const ModelSpec& spec);

}  // namespace io
}  // namespace walktrack
