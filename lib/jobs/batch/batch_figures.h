// The numbers of a result, from its run.json and gait.json, that appear in tables of many results.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

namespace walktrack {
inline namespace jobs {

struct BatchFigure {
  std::string_view column;   // of summary.csv
  std::string_view heading;  // of batch.html
  int digits;                // number of decimals
};

inline constexpr std::array<BatchFigure, 7> kBatchFigures{{
    {"lost_percent", "lost, %", 1},
    {"speed_m_s", "speed, m/s", 2},
    {"cadence_steps_per_min", "cadence, /min", 0},
    {"step_length_m", "step length, m", 3},
    {"stance_percent", "stance, %", 1},
    {"foot_slide_mm", "foot slide, mm", 0},
    {"penetration_mm", "penetration, mm", 0},
}};
using BatchFigures = std::array<std::optional<double>, kBatchFigures.size()>;

// For a complete result: `run` is its run.json, `folder` contains its gait.json. Numbers that are
// missing stay empty.
BatchFigures figures_of(const nlohmann::json& run, const std::filesystem::path& folder);

}  // namespace jobs
}  // namespace walktrack
