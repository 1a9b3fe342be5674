#include "io/tables/kinetics_file.h"

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/conventions.h"
#include "io/tables/csv.h"

namespace walktrack {
inline namespace io {

namespace {

using Eigen::Vector3d;
using Json = nlohmann::ordered_json;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

std::vector<std::string> column_names() {
  std::vector<std::string> out;
  const auto vector = [&](const std::string& name, const char* unit) {
    for (const char* axis : {"x", "y", "z"})
      out.push_back(fmt::format("{}_{}_{}", name, axis, unit));
  };
  vector("com", "m");
  for (const char* side : {"l", "r"}) {
    vector(fmt::format("{}_grf", side), "n");
    vector(fmt::format("{}_cop", side), "m");
    out.push_back(fmt::format("{}_free_moment_nm", side));
  }
  for (const char* side : {"l", "r"})
    for (const char* name : {"hip_flexion_nm", "hip_abduction_nm", "knee_flexion_nm",
                             "ankle_dorsiflexion_nm", "hip_w", "knee_w", "ankle_w"})
      out.push_back(fmt::format("{}_{}", side, name));
  for (const char* name :
       {"kinetic_energy_j", "potential_energy_j", "unexplained_force_n", "unexplained_moment_nm"})
    out.emplace_back(name);
  return out;
}

// The numbers of a frame in the order of the columns, in calibration axes.
std::vector<double> values_of(const KineticsFrame& frame, const WorldFrame& world) {
  std::vector<double> out;
  const auto add = [&](const Vector3d& v) { out.insert(out.end(), v.begin(), v.end()); };
  add(calibration_from_world(world, frame.com));
  for (const FootLoad& foot : frame.feet) {
    add(world.rotation.transpose() * foot.force);
    add(calibration_from_world(world, {foot.centre.x(), foot.centre.y(), 0}));
    out.push_back(foot.free_moment);
  }
  for (const LegLoads& leg : frame.legs)
    out.insert(out.end(), {leg.hip_flexion, leg.hip_abduction, leg.knee_flexion,
                           leg.ankle_dorsiflexion, leg.hip_power, leg.knee_power, leg.ankle_power});
  out.insert(out.end(), {frame.kinetic_energy, frame.potential_energy, frame.unexplained_force,
                         frame.unexplained_moment});
  return out;
}

double rate_of(const Kinetics& kinetics) {
  const size_t n = kinetics.time.size();
  return n > 1 ? static_cast<double>(n - 1) / (kinetics.time.back() - kinetics.time.front()) : 0;
}

Json subject_notes(const Subject& subject) {
  return {{"height_m", json_number(subject.height)}, {"mass_kg", json_number(subject.mass)}};
}

Json totals_notes(const KineticsTotals& totals) {
  return {{"distance_m", json_number(totals.distance)},
          {"positive_work_j", json_number(totals.positive_work)},
          {"negative_work_j", json_number(totals.negative_work)},
          {"cost_of_transport", json_number(totals.cost_of_transport)},
          {"peak_foot_load_body_weights", json_number(totals.peak_load)}};
}

std::string table(const Kinetics& kinetics, const KineticsBands& bands, const WorldFrame& world) {
  const std::vector<std::string> names = column_names();
  std::string text = "t";
  for (const std::string& name : names) text += fmt::format(",{0},{0}_p05,{0}_p95", name);
  text += "\n";
  for (size_t i = 0; i < kinetics.frames.size(); ++i) {
    text += csv_number(kinetics.time[i]);
    const std::vector<double> values = kinetics.frames[i].known
                                           ? values_of(kinetics.frames[i], world)
                                           : std::vector<double>(names.size(), kNone);
    for (size_t k = 0; k < names.size(); ++k) {
      const double half = bands.half_width(i, k, kinetics.frames[i]);
      for (const double value : {values[k], values[k] - half, values[k] + half})
        append_number(text, ',', value);
    }
    text += "\n";
  }
  return text;
}

}  // namespace

void KineticsBands::add(const Kinetics& member) {
  rows_.resize(member.frames.size());
  for (size_t i = 0; i < rows_.size(); ++i) {
    if (!member.frames[i].known) continue;
    const std::vector<double> values = values_of(member.frames[i], world_);
    rows_[i].columns.resize(values.size());
    ++rows_[i].members;
    for (size_t k = 0; k < values.size(); ++k) {
      if (!std::isfinite(values[k])) continue;
      Sum& sum = rows_[i].columns[k];
      const double away = values[k] - sum.mean;
      sum.mean += away / ++sum.count;
      sum.squares += away * (values[k] - sum.mean);
    }
  }
}

// The share of the error of the vertical load in a column, N; columns are those of values_of().
double KineticsBands::model_error(size_t column, const KineticsFrame& frame) const {
  constexpr size_t kFirstFoot = 3, kColumnsOfFoot = 7, kAxes = 3;
  if (column < kFirstFoot || column >= kFirstFoot + 2 * kColumnsOfFoot) return 0;
  const size_t foot = (column - kFirstFoot) / kColumnsOfFoot;
  const size_t axis = (column - kFirstFoot) % kColumnsOfFoot;
  if (axis >= kAxes || !frame.feet[foot].centre.allFinite()) return 0;
  return load_error_ * std::abs(world_.rotation(2, static_cast<Eigen::Index>(axis)));
}

double KineticsBands::half_width(size_t row, size_t column, const KineticsFrame& frame) const {
  if (row >= rows_.size() || rows_[row].members == 0) return kNone;
  const Sum& sum = rows_[row].columns[column];
  if (sum.count < 2 || 2 * sum.count < rows_[row].members) return kNone;
  return kBandQuantile *
         std::hypot(std::sqrt(sum.squares / (sum.count - 1)), model_error(column, frame));
}

std::string kinetics_csv(const Kinetics& kinetics, const KineticsBands& bands,
                         const WorldFrame& world) {
  return table(kinetics, bands, world);
}

std::string simulated_kinetics_csv(const Kinetics& kinetics) {
  return table(kinetics, KineticsBands({}), {});
}

TableNotes kinetics_notes(const Kinetics& kinetics, const Subject& subject,
                          const KineticsConfig& config) {
  const double edge = config.cutoff_hz > 0 ? 0.5 / config.cutoff_hz : 0;
  const nlohmann::ordered_json notes = {
      {"rate_hz", json_number(rate_of(kinetics))},
      {"what", "inverse dynamics of the motion"},
      {"units", "SI units as named; vectors in the world axes of the calibration"},
      {"bands", "_p05, _p95: 5-95 % band of the tracker; empty where nothing is known"},
      {"subject", subject_notes(subject)},
      {"mass", "forces and moments are as right as the subject's mass"},
      {"smoothed_below_hz", json_number(config.cutoff_hz)},
      {"smoothing",
       fmt::format("joint centres, without lag; within {:.2f} s of the ends of a tracked span "
                   "values lean on its extrapolation",
                   edge)},
      {"feet", "in double support the feet's shares are modelled"},
      {"moments",
       "of the muscles, positive as the angle's name says (pushing off: ankle_dorsiflexion_nm < "
       "0)"},
      {"totals", totals_notes(kinetics.totals)},
      {"totals_of", "positive and negative work: of hips, knees and ankles"}};
  return {"kinetics.csv", notes.dump()};
}

TableNotes simulated_kinetics_notes(const Kinetics& kinetics, const Subject& subject) {
  const nlohmann::ordered_json notes = {
      {"rate_hz", json_number(rate_of(kinetics))},
      {"what", "truth of a simulated walk"},
      {"units", "SI units as named; vectors in the world axes"},
      {"forces",
       "means over the time of a row, impulses of strike and toe-off included; moments of "
       "joints are not stated"},
      {"subject", subject_notes(subject)}};
  return {"kinetics.csv", notes.dump()};
}

GroundForces read_ground_forces(const std::filesystem::path& path) {
  std::vector<std::string> names{"t"};
  for (const char* side : {"l", "r"})
    for (const char* axis : {"x", "y", "z"})
      names.push_back(fmt::format("{}_grf_{}_n", side, axis));
  const auto columns = read_csv_columns(path, names);
  GroundForces out;
  out.time = columns[0];
  for (size_t row = 0; row < out.time.size(); ++row) {
    const auto vector = [&](size_t first) {
      return Vector3d(columns[first][row], columns[first + 1][row], columns[first + 2][row]);
    };
    out.feet.push_back({vector(1), vector(4)});
  }
  return out;
}

}  // namespace io
}  // namespace walktrack
