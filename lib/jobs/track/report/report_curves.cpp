#include "jobs/track/report/report_curves.h"

#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "io/tables/csv.h"
#include "metrics/cycle_curve.h"

namespace walktrack {
inline namespace jobs {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::array kSides{Side::kLeft, Side::kRight};

Signal read_signal(const std::filesystem::path& table, const std::string& column) {
  auto columns = read_csv_columns(table, {"t", column, column + "_p05", column + "_p95"});
  return {column,
          Side::kLeft,
          std::move(columns[0]),
          std::move(columns[1]),
          std::move(columns[2]),
          std::move(columns[3])};
}

Signal scaled(Signal signal, double factor) {
  for (auto* values : {&signal.value, &signal.p05, &signal.p95})
    for (double& value : *values) value *= factor;
  if (factor < 0) std::swap(signal.p05, signal.p95);
  return signal;
}

Signal named(Signal signal, std::string name, Side side) {
  signal.name = std::move(name);
  signal.side = side;
  return signal;
}

// The sum of signals at equal times. Their bands are added, which is the largest uncertainty that
// they can have together.
Signal sum(Signal a, const Signal& b) {
  for (size_t i = 0; i < a.value.size(); ++i) {
    a.value[i] += b.value[i];
    a.p05[i] += b.p05[i];
    a.p95[i] += b.p95[i];
  }
  return a;
}

Json curve(const CycleCurve& values) {
  Json out = Json::array();
  for (const double value : values)
    out.push_back(std::isfinite(value) ? Json(std::round(1000 * value) / 1000) : Json());
  return out;
}

Json cycle_json(const Signal& signal, const std::vector<Stride>& strides) {
  std::vector<CycleCurve> values, low, high;
  Json cut = Json::array();
  for (const Stride& stride : strides) {
    if (stride.side != signal.side) continue;
    values.push_back(over_stride(signal.time, signal.value, stride));
    low.push_back(over_stride(signal.time, signal.p05, stride));
    high.push_back(over_stride(signal.time, signal.p95, stride));
    cut.push_back({{"from", stride.from},
                   {"to", stride.to},
                   {"toe_off", stride.toe_off},
                   {"values", curve(values.back())}});
  }
  const CycleBand mean = band_of(values);
  return {{"name", signal.name},
          {"side", signal.side == Side::kLeft ? "left" : "right"},
          {"count", mean.count},
          {"mean", curve(mean.mean)},
          {"p05", curve(band_of(low).mean)},
          {"p95", curve(band_of(high).mean)},
          {"strides", cut}};
}

}  // namespace

std::vector<Signal> angle_signals(const std::filesystem::path& folder) {
  const auto table = folder / "angles.csv";
  std::vector<Signal> out;
  for (const Side side : kSides) {
    const char letter = side == Side::kLeft ? 'l' : 'r';
    const auto add = [&](const char* name, const std::string& from, double factor = 1) {
      out.push_back(named(scaled(read_signal(table, from), factor), name, side));
    };
    add("hip_flexion", fmt::format("hip_flexion_{}_deg", letter));
    add("knee_flexion", fmt::format("knee_angle_{}_deg", letter));
    add("ankle_dorsiflexion", fmt::format("ankle_angle_{}_deg", letter));
    add("pelvis_tilt", "pelvis_tilt_deg", -1);
  }
  return out;
}

std::vector<Signal> more_angle_signals(const std::filesystem::path& folder) {
  const auto table = folder / "angles.csv";
  std::vector<Signal> out;
  for (const Side side : kSides) {
    const char letter = side == Side::kLeft ? 'l' : 'r';
    for (const char* name : {"hip_adduction", "hip_rotation"})
      out.push_back(named(read_signal(table, fmt::format("{}_{}_deg", name, letter)), name, side));
    for (const char* name : {"pelvis_list", "pelvis_rotation", "lumbar_bending", "lumbar_rotation"})
      out.push_back(named(read_signal(table, fmt::format("{}_deg", name)), name, side));
    for (const char* name : {"lumbar_extension", "trunk_tilt"})
      out.push_back(named(scaled(read_signal(table, fmt::format("{}_deg", name)), -1), name, side));
  }
  return out;
}

std::vector<Signal> load_signals(const ResultFolder& folder, const AnalysedMotion& analysed) {
  const auto table = folder.file("kinetics.csv");
  const double mass = analysed.subject.mass, weight = mass * analysed.gravity.norm();
  const Eigen::Vector3d up = analysed.world.rotation.transpose() * Eigen::Vector3d::UnitZ();
  std::vector<Signal> out;
  for (const Side side : kSides) {
    const char letter = side == Side::kLeft ? 'l' : 'r';
    Signal load = scaled(read_signal(table, fmt::format("{}_grf_x_n", letter)), up.x() / weight);
    for (const auto& [axis, share] : {std::pair{'y', up.y()}, {'z', up.z()}})
      load = sum(load, scaled(read_signal(table, fmt::format("{}_grf_{}_n", letter, axis)),
                              share / weight));
    out.push_back(named(load, "vertical_load", side));
    for (const char* joint : {"hip_flexion", "knee_flexion", "ankle_dorsiflexion"})
      out.push_back(
          named(scaled(read_signal(table, fmt::format("{}_{}_nm", letter, joint)), 1 / mass),
                fmt::format("{}_moment", joint), side));
  }
  return out;
}

Json cycles_json(const std::vector<Signal>& signals, const Gait& gait) {
  const std::vector<Stride> strides = strides_of(gait);
  Json out = Json::array();
  for (const Signal& signal : signals) out.push_back(cycle_json(signal, strides));
  return out;
}

}  // namespace jobs
}  // namespace walktrack
