// The curves of a report over the gait cycle, read from the tables of a result: joint angles, loads
// and moments of either side, with the filter's bands.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "io/archive/result_folder.h"
#include "jobs/track/results/motion_tables.h"
#include "metrics/gait.h"

namespace walktrack {
inline namespace jobs {

// A number over time and its 5-95 % band; NaN where unknown.
struct Signal {
  std::string name;  // as in normal_gait.csv if it is there, e.g. "knee_flexion"
  Side side = Side::kLeft;
  std::vector<double> time, value, p05, p95;
};

// The main angles in angles.csv of a result folder: degrees, forward lean positive.
std::vector<Signal> angle_signals(const std::filesystem::path& folder);

// The other angles in angles.csv, under its names, in degrees and with its signs, except for
// lumbar_extension and trunk_tilt, of which forward is positive here.
std::vector<Signal> more_angle_signals(const std::filesystem::path& folder);

// From kinetics.csv: vertical load of each foot in body weights, moments in N m/kg.
std::vector<Signal> load_signals(const ResultFolder& folder, const AnalysedMotion& analysed);

// [{name, side, count, mean, p05, p95: [101 numbers], strides: [{from, to, toe_off, values}]}]:
// each signal is cut at the foot strikes of its side. Bands are means of the strides' bands.
nlohmann::ordered_json cycles_json(const std::vector<Signal>& signals, const Gait& gait);

}  // namespace jobs
}  // namespace walktrack
