#include "jobs/batch/batch_figures.h"

#include <string>

#include <nlohmann/json.hpp>

#include "io/archive/files.h"

namespace walktrack {
inline namespace jobs {

namespace {

using RunJson = nlohmann::json;

constexpr size_t kMostGaitBytes = 64u << 20;

// The value at /a/b/c; null if there is none.
RunJson at(const RunJson& json, std::initializer_list<std::string_view> path) {
  const RunJson* place = &json;
  for (const std::string_view key : path) {
    if (!place->is_object() || !place->contains(key)) return {};
    place = &place->at(std::string(key));
  }
  return *place;
}

RunJson quality_value(const RunJson& run, std::string_view name) {
  const RunJson quality = at(run, {"quality"});
  if (!quality.is_array()) return {};
  for (const RunJson& measure : quality) {
    if (at(measure, {"name"}) == name) return at(measure, {"value"});
  }
  return {};
}

RunJson gait_of(const std::filesystem::path& folder) {
  const auto file = folder / "gait.json";
  std::error_code missing;
  if (!std::filesystem::is_regular_file(file, missing)) return {};
  return RunJson::parse(read_text_file(file, kMostGaitBytes), nullptr, false);
}

}  // namespace

BatchFigures figures_of(const RunJson& run, const std::filesystem::path& folder) {
  const RunJson gait = gait_of(folder);
  BatchFigures figures;
  for (size_t i = 0; i < figures.size(); ++i) {
    const std::string_view name = kBatchFigures[i].column;
    RunJson value = quality_value(run, name);
    if (value.is_null()) value = at(gait, {"summary", "both", name, "value"});
    if (value.is_number()) figures[i] = value.get<double>();
  }
  return figures;
}

}  // namespace jobs
}  // namespace walktrack
