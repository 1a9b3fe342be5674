#include "io/config/config.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "core/errors.h"
#include "io/config/config_table.h"
#include "io/config/presets.h"
#include "io/config/renamed_keys.h"
#include "io/config/yaml.h"

namespace walktrack {
inline namespace io {

namespace {

const Parameter* find_parameter(const std::string& key) {
  for (const Parameter& parameter : config_table().parameters) {
    if (parameter.key == key) return &parameter;
  }
  return nullptr;
}

bool is_group(const std::string& prefix) {
  const auto begins = [&](std::string_view key) { return key.starts_with(prefix + "."); };
  return std::ranges::any_of(
             config_table().groups,
             [&](const auto& group) { return group.first == prefix || begins(group.first); }) ||
         std::ranges::any_of(renamed_keys(), begins, &RenamedKey::before);
}

// The present name of the key. Notes it if the key was given by its name in the last release.
std::string current_key(ConfigWithOrigin& config, const InputPlace& place) {
  const auto renamed = std::ranges::find(renamed_keys(), place.key, &RenamedKey::before);
  if (renamed == renamed_keys().end()) return place.key;
  config.renamed.push_back(fmt::format(
      "{}{}: {} is called {} now; the next release refuses the old name", place.file,
      place.line > 0 ? fmt::format(":{}", place.line) : "", renamed->before, renamed->now));
  return std::string(renamed->now);
}

std::string last_part(const std::string& key) { return key.substr(key.rfind('.') + 1); }

// The message names the nearest key, or one of another group whose last part is the same.
std::string unknown_key(const std::string& key) {
  std::vector<std::string> names;
  for (const Parameter& parameter : config_table().parameters) names.push_back(parameter.key);
  std::string nearest = nearest_word(key, names);
  for (size_t i = 0; i < names.size() && nearest.empty(); ++i) {
    if (last_part(names[i]) == last_part(key)) nearest = names[i];
  }
  return nearest.empty() ? "an unknown key"
                         : fmt::format("an unknown key, did you mean '{}'?", nearest);
}

void assign(ConfigWithOrigin& config, const InputPlace& place, const std::string& text,
            const std::string& origin) {
  const std::string key = current_key(config, place);
  const Parameter* parameter = find_parameter(key);
  if (!parameter) {
    throw UsageError(describe(place, unknown_key(place.key), "the keys of 'walktrack config'"));
  }
  if (!parameter->set(config.values, text)) {
    throw UsageError(describe(place, fmt::format("'{}'", text), parameter->allowed));
  }
  config.origin[key] = origin;
}

// A scalar as it is written, a list as "[a, b]".
std::string value_text(const YamlValue& value) {
  if (value.is_scalar()) return value.text();
  if (!value.is_list()) return value.describe_found();
  std::string text;
  for (const YamlValue& item : value.items()) {
    text += fmt::format("{}{}", text.empty() ? "" : ", ", value_text(item));
  }
  return fmt::format("[{}]", text);
}

void apply_map(ConfigWithOrigin& config, const YamlValue& map) {
  const std::vector<std::string> keys = map.keys();
  map.only_keys(keys);  // refuses a key that is written twice
  for (const std::string& name : keys) {
    const std::string key = map.key().empty() ? name : map.key() + "." + name;
    if (!map.has(name)) continue;  // "filter:" without any entry
    const YamlValue value = map.at(name);
    if (value.is_map() && is_group(key)) {
      apply_map(config, value);
    } else {
      assign(config, {map.file(), value.line(), key}, value_text(value),
             fmt::format("{}:{}", std::filesystem::path(map.file()).filename().string(),
                         value.line()));
    }
  }
}

// Reads a file, or the preset of that name if there is no such file. If a bare word is neither, the
// message names both.
YamlValue file_or_preset(const std::string& path) {
  // A folder, for example one of results, may have the name of a preset.
  const bool there = std::filesystem::exists(path);
  if (there && !std::filesystem::is_directory(path)) return YamlValue::from_file(path);
  std::vector<std::string_view> names;
  for (const Preset& preset : presets()) {
    if (preset.name == path)
      return YamlValue::from_text(std::string(preset.yaml), "preset " + path);
    names.push_back(preset.name);
  }
  if (there || path.find_first_of("/.") != std::string::npos) return YamlValue::from_file(path);
  throw UsageError(describe({path, 0, ""}, "no such file",
                            fmt::format("a file, or a preset: {}", fmt::join(names, ", "))));
}

size_t depth(const std::string& key) {
  return static_cast<size_t>(std::count(key.begin(), key.end(), '.'));
}

// For "filter.flow.sd", opens "filter:" and "  flow:" unless they are open already.
void open_groups(std::string& text, std::string& open, const std::string& key) {
  const size_t last_dot = key.rfind('.');
  const std::string group = last_dot == std::string::npos ? "" : key.substr(0, last_dot);
  if (group == open) return;
  for (size_t end = group.find('.');; end = group.find('.', end + 1)) {
    const std::string prefix = group.substr(0, end);
    if (!prefix.empty() && !(open + ".").starts_with(prefix + ".")) {
      text += std::string(2 * depth(prefix), ' ') + prefix.substr(prefix.rfind('.') + 1) + ":";
      for (const auto& [name, about] : config_table().groups) {
        if (name == prefix) text += "  # " + about;
      }
      text += "\n";
    }
    if (end == std::string::npos) break;
  }
  open = group;
}

}  // namespace

void apply_config_file(ConfigWithOrigin& config, const std::string& path) {
  try {
    apply_map(config, file_or_preset(path));
  } catch (const InputError& error) {
    throw UsageError(error.what());  // a wrong configuration is a usage error
  }
}

void apply_setting(ConfigWithOrigin& config, const std::string& setting,
                   const std::string& origin) {
  const size_t equals = setting.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw UsageError(describe({"", 0, origin}, fmt::format("'{}'", setting), "KEY=VALUE"));
  }
  assign(config, {origin, 0, setting.substr(0, equals)}, setting.substr(equals + 1), origin);
}

std::string config_as_yaml(const ConfigWithOrigin& config, ConfigScope scope, bool comments) {
  std::string text, open;
  for (const Parameter& parameter : config_table().parameters) {
    const auto origin = config.origin.find(parameter.key);
    if (scope == ConfigScope::kChanged && origin == config.origin.end()) continue;
    open_groups(text, open, parameter.key);
    const std::string indent(2 * depth(parameter.key), ' ');
    const std::string name = parameter.key.substr(parameter.key.rfind('.') + 1);
    if (comments) {
      text += fmt::format("{}# {}; {}{}\n", indent, parameter.comment, parameter.allowed,
                          origin == config.origin.end() ? "" : "; from " + origin->second);
    }
    text += fmt::format("{}{}: {}\n", indent, name, parameter.get(config.values));
  }
  return text;
}

std::vector<std::pair<std::string, std::string>> config_values(const Config& config) {
  std::vector<std::pair<std::string, std::string>> values;
  for (const Parameter& parameter : config_table().parameters) {
    values.emplace_back(parameter.key, parameter.get(config));
  }
  return values;
}

}  // namespace io
}  // namespace walktrack
