#include "jobs/sweep/sweep_grid.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "core/errors.h"
#include "io/archive/files.h"
#include "io/config/renamed_keys.h"
#include "observation/terms.h"

namespace walktrack {
inline namespace jobs {

namespace {

constexpr const char* kOrigin = "--over";
constexpr std::string_view kCameras = "cameras", kTerms = "terms", kAllTerms = "all",
                           kConfig = "config";
constexpr std::array<std::pair<std::string_view, std::string_view>, 8> kShortNames{
    {{"model", "motion.model"},
     {"path", "motion.path"},
     {"particles", "filter.particles"},
     {"scale", "observation.person_px"},
     {"moves", "filter.moves"},
     {"layers", "filter.max_layers"},
     {"arms", "body.arms"},
     {"keypoints", "observation.keypoints.enabled"}}};

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  for (size_t begin = 0;;) {
    const size_t end = text.find(separator, begin);
    parts.push_back(text.substr(begin, end - begin));
    if (end == std::string::npos) return parts;
    begin = end + 1;
  }
}

std::string key_of(const std::string& name) {
  for (const auto& [word, key] : kShortNames)
    if (name == word) return std::string(key);
  for (const RenamedKey& renamed : renamed_keys())
    if (name == renamed.before) return std::string(renamed.now);
  return name;
}

[[noreturn]] void refuse(const std::string& parameter, const std::string& found,
                         const std::string& allowed) {
  throw UsageError(describe({kOrigin, 0, parameter}, fmt::format("'{}'", found), allowed));
}

void refuse_unknown(const std::string& name) {
  std::vector<std::string> names{std::string(kConfig), std::string(kCameras), std::string(kTerms)};
  for (const auto& [word, key] : kShortNames) names.emplace_back(word);
  const std::string words = fmt::format("{}", fmt::join(names, ", "));
  for (const auto& [key, value] : config_values({})) names.push_back(key);
  if (std::find(names.begin(), names.end(), key_of(name)) != names.end()) return;
  const std::string nearest = nearest_word(name, names);
  throw UsageError(describe({kOrigin, 0, name},
                            nearest.empty()
                                ? "an unknown parameter"
                                : fmt::format("an unknown parameter, did you mean '{}'?", nearest),
                            words + " and the keys of 'walktrack config'"));
}

// The cameras of the scene that a value denotes.
std::vector<SceneCamera> chosen_cameras(const std::string& value,
                                        const std::vector<SceneCamera>& all) {
  std::vector<SceneCamera> chosen;
  for (const std::string& name : split(value, '+')) {
    const auto named = std::find_if(all.begin(), all.end(),
                                    [&](const SceneCamera& camera) { return camera.name == name; });
    if (named == all.end()) break;
    chosen.push_back(*named);
  }
  if (!chosen.empty() && chosen.size() == split(value, '+').size()) return chosen;
  const std::optional<double> count = number_from_text(value);
  for (size_t n = 1; count && n <= all.size(); ++n)
    if (*count == static_cast<double>(n)) return {all.begin(), all.begin() + static_cast<long>(n)};
  std::vector<std::string> names;
  for (const SceneCamera& camera : all) names.push_back(camera.name);
  refuse(std::string(kCameras), value,
         fmt::format("1 to {}, or names of {} joined by +", all.size(), fmt::join(names, ", ")));
}

// The names that `terms` accepts.
std::vector<std::string_view> term_keys() {
  std::vector<std::string_view> names;
  for (const TermSwitch& each : term_switches()) names.push_back(each.key);
  return names;
}

std::vector<std::pair<std::string, std::string>> term_flags(const std::string& value) {
  const std::vector<std::string> on = split(value, '+');
  const std::vector<std::string_view> names = term_keys();
  const bool known = std::all_of(on.begin(), on.end(), [&](const std::string& word) {
    return std::find(names.begin(), names.end(), word) != names.end();
  });
  if (!known && value != kAllTerms)
    refuse(std::string(kTerms), value,
           fmt::format("all, or {} joined by +", fmt::join(names, ", ")));
  std::vector<std::pair<std::string, std::string>> flags;
  for (const std::string_view term : names) {
    const bool enabled = value == kAllTerms || std::find(on.begin(), on.end(), term) != on.end();
    flags.emplace_back(fmt::format("observation.{}.enabled", term), enabled ? "true" : "false");
  }
  return flags;
}

// A number by which settings are ordered, which is larger for one with more terms or cameras;
// nullopt for a word.
std::optional<double> richness(const std::string& parameter, const std::string& value) {
  if (value == "true" || value == "on") return 1;
  if (value == "false" || value == "off") return 0;
  if (value == kAllTerms) return static_cast<double>(term_switches().size());
  const std::optional<double> number = number_from_text(value);
  if (number || (parameter != kCameras && parameter != kTerms)) return number;
  return static_cast<double>(split(value, '+').size());
}

SweptParameter parameter_of(const std::string& word) {
  const size_t equals = word.find('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == word.size())
    throw UsageError(describe({"", 0, kOrigin}, fmt::format("'{}'", word),
                              "NAME=VALUE:VALUE, several separated by commas"));
  SweptParameter parameter{word.substr(0, equals), split(word.substr(equals + 1), ':')};
  refuse_unknown(parameter.name);
  for (size_t i = 0; i < parameter.values.size(); ++i)
    if (std::find(parameter.values.begin(), parameter.values.begin() + static_cast<long>(i),
                  parameter.values[i]) != parameter.values.begin() + static_cast<long>(i))
      refuse(parameter.name, parameter.values[i], "every value once");
  return parameter;
}

}  // namespace

std::vector<SweptParameter> swept_parameters(const std::vector<std::string>& words,
                                             const Scene& scene, const ConfigWithOrigin& config) {
  std::vector<SweptParameter> parameters;
  for (const std::string& list : words) {
    for (const std::string& word : split(list, ',')) {
      SweptParameter parameter = parameter_of(word);
      for (const SweptParameter& other : parameters)
        if (key_of(other.name) == key_of(parameter.name))
          refuse(parameter.name, parameter.name, "every parameter once");
      for (const std::string& value : parameter.values) {
        Scene tried_scene = scene;
        ConfigWithOrigin tried = config;
        apply_sweep_setting({parameter}, {value}, tried_scene, tried);
      }
      parameters.push_back(std::move(parameter));
    }
  }
  return parameters;
}

std::vector<SweepSetting> sweep_grid(const std::vector<SweptParameter>& parameters) {
  std::vector<SweepSetting> grid{{}};
  for (const SweptParameter& parameter : parameters) {
    std::vector<SweepSetting> longer;
    for (const SweepSetting& setting : grid) {
      for (const std::string& value : parameter.values) {
        longer.push_back(setting);
        longer.back().push_back(value);
      }
    }
    grid = std::move(longer);
  }
  return grid;
}

SweepSetting richest_setting(const std::vector<SweptParameter>& parameters) {
  SweepSetting richest;
  for (const SweptParameter& parameter : parameters) {
    richest.push_back(parameter.values.front());
    for (const std::string& value : parameter.values) {
      const auto rich = richness(parameter.name, value),
                 before = richness(parameter.name, richest.back());
      if (!rich || !before || *rich > *before) richest.back() = value;
    }
  }
  return richest;
}

void apply_sweep_setting(const std::vector<SweptParameter>& parameters, const SweepSetting& setting,
                         Scene& scene, ConfigWithOrigin& config) {
  const SettingWords words = setting_words(parameters, setting);
  if (!words.config.empty()) apply_config_file(config, words.config);
  if (!words.cameras.empty()) scene.cameras = chosen_cameras(words.cameras, scene.cameras);
  for (const auto& [key, value] : words.parameters)
    apply_setting(config, key + "=" + value, kOrigin);
}

std::string setting_name(const std::vector<SweptParameter>& parameters,
                         const SweepSetting& setting) {
  std::string name;
  for (size_t i = 0; i < parameters.size(); ++i)
    name += fmt::format("{}{}={}", i == 0 ? "" : " ", parameters[i].name, setting[i]);
  return name;
}

SettingWords setting_words(const std::vector<SweptParameter>& parameters,
                           const SweepSetting& setting) {
  SettingWords words;
  for (size_t i = 0; i < parameters.size(); ++i) {
    if (parameters[i].name == kConfig) {
      words.config = setting[i];
    } else if (parameters[i].name == kCameras) {
      words.cameras = setting[i];
    } else if (parameters[i].name == kTerms) {
      for (auto& flag : term_flags(setting[i])) words.parameters.push_back(std::move(flag));
    } else {
      words.parameters.emplace_back(key_of(parameters[i].name), setting[i]);
    }
  }
  return words;
}

}  // namespace jobs
}  // namespace walktrack
