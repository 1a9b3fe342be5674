#include "io/scene/model_file.h"

#include <algorithm>
#include <sstream>

#include <fmt/format.h>

#include "core/errors.h"
#include "io/archive/files.h"
#include "io/config/parameters.h"
#include "io/config/yaml.h"

namespace walktrack {
inline namespace io {
namespace {

constexpr const char* kParameters = "parameters.";
constexpr const char* kArticulated = "articulated";  // the three-dimensional body of `simulate`,
                                                     // not a planar walker

void collect(const YamlValue& value, std::vector<ModelSetting>& settings) {
  if (value.is_map()) {
    for (const std::string& key : value.keys()) {
      if (!value.has(key)) {
        const std::string path = value.key().empty() ? key : value.key() + "." + key;
        throw UsageError(describe({value.file(), value.line(), path}, "nothing", "a value"));
      }
      collect(value.at(key), settings);
    }
    return;
  }
  settings.push_back({value.file(), value.line(), value.key(),
                      value.is_list() ? list_text(value.numbers()) : value.text()});
}

// Numbers separated by commas, with or without brackets.
bool list_from_text(std::string text, const ModelEntry& entry) {
  if (text.size() >= 2 && text.front() == '[' && text.back() == ']') {
    text = text.substr(1, text.size() - 2);
  }
  std::vector<double> numbers;
  std::istringstream words(text);
  for (std::string word; std::getline(words, word, ',');) {
    const auto number = number_from_text(word);
    if (!number || !(*number >= entry.lowest && *number <= entry.highest)) return false;
    numbers.push_back(*number);
  }
  if (numbers.empty() || (entry.count > 0 && numbers.size() != entry.count)) return false;
  *entry.list = numbers;
  return true;
}

bool set_entry(const ModelEntry& entry, const std::string& text) {
  if (entry.number) return number_in_range(text, entry.lowest, entry.highest, *entry.number);
  if (entry.flag) return flag_from_text(text, *entry.flag);
  return list_from_text(text, entry);
}

std::string allowed_text(const ModelEntry& entry) {
  if (entry.number) return number_allowed(entry.lowest, entry.highest) + ": " + entry.comment;
  if (entry.flag) return "true or false";
  const std::string count = entry.count > 0 ? fmt::format("{} ", entry.count) : "";
  return fmt::format("{}numbers with commas between them, {:g} to {:g}: {}", count, entry.lowest,
                     entry.highest, entry.comment);
}

[[noreturn]] void fail(const ModelSetting& setting, const std::string& found,
                       const std::string& allowed) {
  throw UsageError(describe({setting.file, setting.line, setting.key}, found, allowed));
}

void set_value(const std::vector<ModelEntry>& entries, const ModelSetting& setting) {
  std::vector<std::string> keys;
  for (const ModelEntry& entry : entries) {
    if (entry.key == setting.key || entry.key == kParameters + setting.key) {
      if (set_entry(entry, setting.text)) return;
      fail(setting, fmt::format("'{}'", setting.text), allowed_text(entry));
    }
    keys.push_back(entry.key);
  }
  if (setting.line > 0) keys.push_back("model");
  std::string nearest = nearest_word(setting.key, keys);
  if (nearest.empty()) nearest = nearest_word(kParameters + setting.key, keys);
  fail(setting,
       nearest.empty() ? "an unknown key"
                       : fmt::format("an unknown key, did you mean '{}'?", nearest),
       fmt::format("{}", fmt::join(keys, ", ")));
}

bool is_model(const std::string& name) {
  const auto& names = model_names();
  return name == kArticulated || std::find(names.begin(), names.end(), name) != names.end();
}

// A start must have as many numbers as the walker has coordinates.
void check_start(const ModelSpec& spec, size_t count, const ModelSetting& setting) {
  const auto check = [&](const char* key, const std::vector<double>& values) {
    if (setting.key != key || values.size() == count) return;
    fail(setting, fmt::format("{} numbers", values.size()),
         fmt::format("{}, one for each coordinate", count));
  };
  check("start.q", spec.start.q);
  check("start.qd", spec.start.qd);
}

ModelSetting from_text(const std::string& setting) {
  const size_t equals = setting.find('=');
  if (equals == std::string::npos) {
    throw UsageError(describe({"", 0, "--set"}, fmt::format("'{}'", setting), "KEY=VALUE"));
  }
  return {"--set", 0, setting.substr(0, equals), setting.substr(equals + 1)};
}

}  // namespace

std::vector<ModelSetting> read_model_settings(const std::string& path) {
  std::vector<ModelSetting> settings;
  const YamlValue root = YamlValue::from_file(path);
  if (!root.is_map()) root.fail(root.describe_found(), "a map of keys, such as 'model: kneed'");
  collect(root, settings);
  return settings;
}

void apply_model_settings(const std::vector<ModelEntry>& entries, const std::string& file,
                          const std::vector<std::string>& settings) {
  if (!file.empty()) {
    for (const ModelSetting& setting : read_model_settings(file)) {
      if (setting.key != "model") set_value(entries, setting);
    }
  }
  for (const std::string& setting : settings) set_value(entries, from_text(setting));
}

void apply_model_setting(ModelSpec& spec, const std::string& setting) {
  set_value(entries(spec), from_text(setting));
}

std::string model_name(const std::string& name, const std::string& file) {
  const std::string known = fmt::format("{}", fmt::join(model_names(), ", "));
  const std::vector<ModelSetting> settings =
      file.empty() ? std::vector<ModelSetting>() : read_model_settings(file);
  for (const ModelSetting& setting : settings) {
    if (setting.key != "model") continue;
    if (!name.empty() && name != setting.text) {
      fail(setting, fmt::format("'{}'", setting.text), fmt::format("'{}', as --model says", name));
    }
    if (!is_model(setting.text)) fail(setting, fmt::format("'{}'", setting.text), known);
    return setting.text;
  }
  if (!name.empty()) return name;
  if (file.empty()) throw UsageError(describe({"", 0, "--model"}, "nothing", known));
  for (const ModelSetting& setting : settings) {
    if (nearest_word(setting.key, {"model"}).empty()) continue;
    fail(setting, "an unknown key, did you mean 'model'?", "'model: NAME': " + known);
  }
  throw UsageError(describe({file, 0, "model"}, "nothing", known + " (here or as --model)"));
}

ModelSpec read_model(const std::string& name, const std::string& file,
                     const std::vector<std::string>& settings) {
  ModelSpec spec = default_model(model_name(name, file));
  apply_model_settings(entries(spec), file, settings);
  const size_t count = make_walker(spec)->section_size();
  std::vector<ModelSetting> said =
      file.empty() ? std::vector<ModelSetting>() : read_model_settings(file);
  for (const std::string& setting : settings) said.push_back(from_text(setting));
  for (const ModelSetting& setting : said) check_start(spec, count, setting);
  return spec;
}

std::string model_as_yaml(const ModelSpec& spec) {
  ModelSpec copy = spec;  // entries() refers to its argument
  std::string text = fmt::format("model: {}\n", spec.model);
  std::vector<std::string> open;  // groups that are open
  for (const ModelEntry& entry : entries(copy)) {
    std::vector<std::string> path;
    std::istringstream words(entry.key);
    for (std::string word; std::getline(words, word, '.');) path.push_back(word);
    const std::string name = path.back();
    path.pop_back();
    size_t shared = 0;
    while (shared < std::min(open.size(), path.size()) && open[shared] == path[shared]) ++shared;
    for (size_t i = shared; i < path.size(); ++i) {
      text += fmt::format("{:{}}{}:\n", "", 2 * i, path[i]);
    }
    open = path;
    std::string value;
    if (entry.number) value = shortest_number(*entry.number);
    if (entry.flag) value = *entry.flag ? "true" : "false";
    if (entry.list) value = list_text(*entry.list);
    text += fmt::format("{:{}}{}: {}  # {}\n", "", 2 * path.size(), name, value, entry.comment);
  }
  return text;
}

}  // namespace io
}  // namespace walktrack
