#include "io/archive/run_record.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/version.h"
#include "io/archive/files.h"
#include "io/archive/sha256.h"

namespace walktrack {
inline namespace io {

namespace {

using Json = nlohmann::ordered_json;

// Converts numbers, flags and lists to their JSON types; words stay text.
Json typed(const std::string& text) {
  const Json value = Json::parse(text, nullptr, false);
  return value.is_discarded() ? Json(text) : value;
}

// Converts "filter.flow.sd" to {"filter": {"flow": {"sd": …}}}. `threads` is left out, because it
// changes no result.
Json nested_config(const ConfigWithOrigin& config) {
  Json root = Json::object();
  for (const auto& [key, text] : config_values(config.values)) {
    if (key == "threads") continue;
    Json* place = &root;
    for (size_t at = 0;;) {
      const size_t dot = key.find('.', at);
      place = &(*place)[key.substr(at, dot - at)];
      if (dot == std::string::npos) break;
      at = dot + 1;
    }
    *place = typed(text);
  }
  return root;
}

Json origins(const ConfigWithOrigin& config) {
  Json root = Json::object();
  for (const auto& [key, origin] : config.origin) {
    if (key != "threads") root[key] = origin;
  }
  return root;
}

Json quality_list(const std::vector<QualityMeasure>& quality) {
  Json list = Json::array();
  for (const QualityMeasure& m : quality) {
    list.push_back({{"name", m.name},
                    {"what", m.what},
                    {"meaning", m.meaning},
                    {"advice", m.advice},
                    {"value", m.value},
                    {"unit", m.unit},
                    {"digits", m.digits},
                    {"gate", m.limit ? Json(*m.limit) : Json()},
                    {"at_most", m.at_most},
                    {"passed", m.passed()}});
  }
  return list;
}

Json constants_list(const std::vector<RecordingConstant>& constants) {
  Json list = Json::array();
  for (const RecordingConstant& each : constants) {
    list.push_back({{"name", each.name},
                    {"what", each.what},
                    {"value", each.value},
                    {"sd", each.sd},
                    {"unit", each.unit},
                    {"digits", each.digits},
                    {"effect", each.effect}});
  }
  return list;
}

template <typename Pairs>
Json object_of(const Pairs& pairs) {
  Json root = Json::object();
  for (const auto& [name, value] : pairs) root[name] = value;
  return root;
}

std::string plain(const Json& value) {
  return value.is_string() ? value.get<std::string>() : value.dump();
}

// Converts {"filter": {"particles": 120}} to {"filter.particles", "120"}.
void append_settings(const Json& config, const std::string& before, Origin& out) {
  for (const auto& [key, value] : config.items()) {
    if (value.is_object()) {
      append_settings(value, fmt::format("{}{}.", before, key), out);
    } else {
      out.emplace_back(before + key, plain(value));
    }
  }
}

std::string program_in(const Json& program) {
  std::string text;
  for (const char* key : {"version", "commit", "build", "compiler"})
    if (program.contains(key)) text.append(text.empty() ? "" : " ").append(plain(program[key]));
  return text;
}

}  // namespace

std::string run_json(const RunRecord& record) {
  const BuildFacts& facts = build_facts();
  Json root;
  root["program"] = {{"name", "walktrack"},
                     {"version", facts.version},
                     {"commit", facts.commit},
                     {"build", facts.build_type},
                     {"compiler", facts.compiler}};
  root["command"] = record.command;
  root["status"] = record.status;
  root["notes"] = record.notes;
  root["scene"] = {{"file", record.scene}, {"sha256", record.scene_digest}};
  root["inputs"] = object_of(record.inputs);
  root["seed"] = record.config.values.seed;
  root["config"] = nested_config(record.config);
  root["config_origin"] = origins(record.config);
  root["numbers"] = object_of(record.numbers);
  root["constants"] = constants_list(record.constants);
  root["quality"] = quality_list(record.quality);
  root["by_frame"] = object_of(record.by_frame);
  root["digest"] = record.digest;
  root["timing"] = {{"command_line", record.command_line},
                    {"threads", record.threads},
                    {"seconds", record.seconds},
                    {"resumed_at_frame", record.resumed_at_frame},
                    {"stage_seconds", object_of(record.stage_seconds)},
                    {"stage_cpu_seconds", object_of(record.stage_cpu_seconds)}};
  if (record.cpu_seconds) root["timing"]["cpu_seconds"] = *record.cpu_seconds;
  if (record.frames_per_second) {
    const auto& stride = record.stride_frames_per_second;
    root["timing"]["frames_per_second"] = *record.frames_per_second;
    root["timing"]["stride_frames_per_second"] = stride ? Json(*stride) : Json();
  }
  // Names come from outside and may contain invalid UTF-8.
  return root.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Origin origin_in(const std::string& run_json) {
  const Json root = Json::parse(run_json, nullptr, false);
  if (!root.is_object()) return {};
  const auto object = [&](const char* key) {
    return root.contains(key) && root[key].is_object() ? root[key] : Json::object();
  };
  Origin out{{"version of the program", program_in(object("program"))}};
  const Json inputs = object("inputs");
  for (const auto& [file, digest] : inputs.items())
    out.emplace_back(fmt::format("{}{}", kContentOf, file), plain(digest));
  append_settings(object("config"), "", out);
  return out;
}

std::optional<std::string> command_of_result(const std::filesystem::path& folder) {
  constexpr size_t kMaxBytes = size_t{1} << 30;
  const std::filesystem::path file = folder / "run.json";
  if (!std::filesystem::exists(file)) return std::nullopt;
  const Json root = Json::parse(read_text_file(file, kMaxBytes), nullptr, false);
  if (!root.is_object() || !root.contains("command") || !root["command"].is_string())
    return std::nullopt;
  return root["command"].get<std::string>();
}

std::string result_digest(const std::string& joints_csv, const std::string& uncertainty_csv) {
  return sha256(joints_csv + uncertainty_csv);
}

}  // namespace io
}  // namespace walktrack
