// The data that `walktrack compare` reads from a result: the curves and numbers of every stride, by
// side.
#pragma once

#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "jobs/compare/compare.h"

namespace walktrack {
inline namespace jobs {

struct ComparedAngle {
  std::string_view name;  // as in report_curves.h
  std::string_view label;
};
inline constexpr std::array<ComparedAngle, 4> kComparedAngles{
    {{"hip_flexion", "Hip flexion"},
     {"knee_flexion", "Knee flexion"},
     {"ankle_dorsiflexion", "Ankle dorsiflexion"},
     {"pelvis_tilt", "Pelvis forward tilt"}}};

struct ComparedParameter {
  std::string_view name;  // in compare.json
  std::string_view label, unit;
  int digits;  // decimals in text
};
// The first nine belong to the contacts of a foot (gait.json), the others to the angles of a
// stride.
inline constexpr std::array<ComparedParameter, 15> kComparedParameters{
    {{"speed_m_s", "Walking speed, of strides", "m/s", 2},
     {"cadence_steps_per_min", "Cadence, of steps", "steps/min", 1},
     {"step_length_m", "Step length", "m", 3},
     {"step_width_m", "Step width", "m", 3},
     {"step_time_s", "Step time", "s", 3},
     {"stride_length_m", "Stride length", "m", 3},
     {"stride_time_s", "Stride time", "s", 3},
     {"stance_percent", "Stance", "% of stride", 1},
     {"double_support_percent", "Double support", "% of stride", 1},
     {"hip_flexion_range_deg", "Hip, range", "°", 1},
     {"hip_flexion_max_deg", "Hip, greatest flexion", "°", 1},
     {"knee_flexion_range_deg", "Knee, range", "°", 1},
     {"knee_flexion_max_deg", "Knee, greatest flexion", "°", 1},
     {"ankle_dorsiflexion_range_deg", "Ankle, range", "°", 1},
     {"ankle_dorsiflexion_max_deg", "Ankle, greatest dorsiflexion", "°", 1}}};

// The strides of one side of a result.
struct SideStrides {
  // The curves of whole strides, 101 points each, degrees.
  std::array<std::vector<std::vector<double>>, kComparedAngles.size()> curves;
  // One number for each contact or stride in which it is known.
  std::array<std::vector<double>, kComparedParameters.size()> values;
  // Standard deviation of the mean of `values` by the result's own bands; NaN without bands.
  std::array<double, kComparedParameters.size()> band_sd;
};

struct ComparedTrial {
  std::filesystem::path folder;
  std::string name;                  // of the folder
  std::string status;                // of run.json
  std::vector<std::string> failed;   // quality checks, in words
  std::array<SideStrides, 2> sides;  // left, right
};

struct ComparedGroup {
  std::string name;
  std::vector<ComparedTrial> trials;  // at least one
};

// InputError that names a folder without a complete result of `track` or `analyse`.
ComparedTrial read_trial(const std::filesystem::path& folder);

// In the order of the places, and by name within a place. InputError if there is no result.
ComparedGroup read_group(const CompareGroup& group);

}  // namespace jobs
}  // namespace walktrack
