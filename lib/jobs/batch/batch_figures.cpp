#include "jobs/batch/batch_figures.h"

#include <string>

#include <nlohmann/json.hpp>

#include "io/archive/files.h"

namespace walktrack {

namespace {

using Json = nlohmann::json;

constexpr size_t kMostGaitBytes = 64u << 20;

// What is at /a/b/c; null where nothing is.
Json at(const Json& json, std::initializer_list<std::string_view> path) {
  const Json* place = &json;
  for (const std::string_view key : path) {
    if (!place->is_object() || !place->contains(key)) return {};
    place = &place->at(std::string(key));
  }
  return *place;
}

Json quality_value(const Json& run, std::string_view name) {
  const Json quality = at(run, {"quality"});
  if (!quality.is_array()) return {};
  for (const Json& measure : quality) {
    if (at(measure, {"name"}) == name) return at(measure, {"value"});
  }
  return {};
}

Json gait_of(const std::filesystem::path& folder) {
  const auto file = folder / "gait.json";
  std::error_code missing;
  if (!std::filesystem::is_regular_file(file, missing)) return {};
  return Json::parse(read_text_file(file, kMostGaitBytes), nullptr, false);
}

}  // namespace

BatchFigures figures_of(const Json& run, const std::filesystem::path& folder) {
  const Json gait = gait_of(folder);
  BatchFigures figures;
  for (size_t i = 0; i < figures.size(); ++i) {
    const std::string_view name = kBatchFigures[i].column;
    Json value = quality_value(run, name);
    if (value.is_null()) value = at(gait, {"summary", "both", name, "value"});
    if (value.is_number()) figures[i] = value.get<double>();
  }
  return figures;
}

}  // namespace walktrack
