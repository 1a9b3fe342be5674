#include "jobs/sweep/sweep_grid.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "core/errors.h"
#include "io/archive/files.h"
#include "observation/terms.h"

namespace walktrack {

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
  return name;
}

[[noreturn]] void refuse(const std::string& knob, const std::string& found,
                         const std::string& allowed) {
  throw UsageError(describe({kOrigin, 0, knob}, fmt::format("'{}'", found), allowed));
}

void refuse_unknown(const std::string& name) {
  std::vector<std::string> names{std::string(kConfig), std::string(kCameras), std::string(kTerms)};
  for (const auto& [word, key] : kShortNames) names.emplace_back(word);
  const std::string words = fmt::format("{}", fmt::join(names, ", "));
  for (const auto& [key, value] : config_values({})) names.push_back(key);
  if (std::find(names.begin(), names.end(), name) != names.end()) return;
  const std::string nearest = nearest_word(name, names);
  throw UsageError(describe({kOrigin, 0, name},
                            nearest.empty()
                                ? "an unknown knob"
                                : fmt::format("an unknown knob, did you mean '{}'?", nearest),
                            words + " and the keys of 'walktrack config'"));
}

// Which of the scene's cameras a value stands for.
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

// The words that `terms` takes.
std::vector<std::string_view> term_names() {
  std::vector<std::string_view> names;
  for (const TermSwitch& each : term_switches()) names.push_back(each.key);
  return names;
}

std::vector<std::pair<std::string, std::string>> term_flags(const std::string& value) {
  const std::vector<std::string> on = split(value, '+');
  const std::vector<std::string_view> names = term_names();
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

// How much a value promises; nullopt for a word.
std::optional<double> richness(const std::string& knob, const std::string& value) {
  if (value == "true" || value == "on") return 1;
  if (value == "false" || value == "off") return 0;
  if (value == kAllTerms) return static_cast<double>(term_switches().size());
  const std::optional<double> number = number_from_text(value);
  if (number || (knob != kCameras && knob != kTerms)) return number;
  return static_cast<double>(split(value, '+').size());
}

SweepKnob knob_of(const std::string& word) {
  const size_t equals = word.find('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == word.size())
    throw UsageError(describe({"", 0, kOrigin}, fmt::format("'{}'", word),
                              "NAME=VALUE:VALUE, several separated by commas"));
  SweepKnob knob{word.substr(0, equals), split(word.substr(equals + 1), ':')};
  refuse_unknown(knob.name);
  for (size_t i = 0; i < knob.values.size(); ++i)
    if (std::find(knob.values.begin(), knob.values.begin() + static_cast<long>(i),
                  knob.values[i]) != knob.values.begin() + static_cast<long>(i))
      refuse(knob.name, knob.values[i], "every value once");
  return knob;
}

}  // namespace

std::vector<SweepKnob> sweep_knobs(const std::vector<std::string>& words, const Scene& scene,
                                   const ConfigWithOrigin& config) {
  std::vector<SweepKnob> knobs;
  for (const std::string& list : words) {
    for (const std::string& word : split(list, ',')) {
      SweepKnob knob = knob_of(word);
      for (const SweepKnob& other : knobs)
        if (key_of(other.name) == key_of(knob.name))
          refuse(knob.name, knob.name, "every knob once");
      for (const std::string& value : knob.values) {
        Scene tried_scene = scene;
        ConfigWithOrigin tried = config;
        apply_sweep_setting({knob}, {value}, tried_scene, tried);
      }
      knobs.push_back(std::move(knob));
    }
  }
  return knobs;
}

std::vector<SweepSetting> sweep_grid(const std::vector<SweepKnob>& knobs) {
  std::vector<SweepSetting> grid{{}};
  for (const SweepKnob& knob : knobs) {
    std::vector<SweepSetting> longer;
    for (const SweepSetting& setting : grid) {
      for (const std::string& value : knob.values) {
        longer.push_back(setting);
        longer.back().push_back(value);
      }
    }
    grid = std::move(longer);
  }
  return grid;
}

SweepSetting richest_setting(const std::vector<SweepKnob>& knobs) {
  SweepSetting richest;
  for (const SweepKnob& knob : knobs) {
    richest.push_back(knob.values.front());
    for (const std::string& value : knob.values) {
      const auto rich = richness(knob.name, value), before = richness(knob.name, richest.back());
      if (!rich || !before || *rich > *before) richest.back() = value;
    }
  }
  return richest;
}

void apply_sweep_setting(const std::vector<SweepKnob>& knobs, const SweepSetting& setting,
                         Scene& scene, ConfigWithOrigin& config) {
  const SettingWords words = setting_words(knobs, setting);
  if (!words.config.empty()) apply_config_file(config, words.config);
  if (!words.cameras.empty()) scene.cameras = chosen_cameras(words.cameras, scene.cameras);
  for (const auto& [key, value] : words.parameters)
    apply_setting(config, key + "=" + value, kOrigin);
}

std::string setting_name(const std::vector<SweepKnob>& knobs, const SweepSetting& setting) {
  std::string name;
  for (size_t i = 0; i < knobs.size(); ++i)
    name += fmt::format("{}{}={}", i == 0 ? "" : " ", knobs[i].name, setting[i]);
  return name;
}

SettingWords setting_words(const std::vector<SweepKnob>& knobs, const SweepSetting& setting) {
  SettingWords words;
  for (size_t i = 0; i < knobs.size(); ++i) {
    if (knobs[i].name == kConfig) {
      words.config = setting[i];
    } else if (knobs[i].name == kCameras) {
      words.cameras = setting[i];
    } else if (knobs[i].name == kTerms) {
      for (auto& flag : term_flags(setting[i])) words.parameters.push_back(std::move(flag));
    } else {
      words.parameters.emplace_back(key_of(knobs[i].name), setting[i]);
    }
  }
  return words;
}

}  // namespace walktrack
