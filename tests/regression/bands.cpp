#include "tests/regression/bands.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "core/errors.h"
#include "io/tables/csv.h"
#include "metrics/statistics.h"

namespace walktrack {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kDeviations = 2;

// Expected difference of the sixth and the second smallest of seven standard normal values
// (Teichroew, Annals of Mathematical Statistics 27, 1956).
constexpr double kInnerRange = 2 * 0.7574;

constexpr WatchedFigure kWatched[] = {
    {"filled_percent", Better::kHigher, 5},
    {"joint_error_mean_mm", Better::kLower, 15},
    {"joint_error_relative_mm", Better::kLower, 10},
    {"joint_error_procrustes_mm", Better::kLower, 8},
    {"swapped_percent", Better::kLower, 5},
    {"offset_along_mm", Better::kNearerZero, 10},
    {"offset_left_mm", Better::kNearerZero, 10},
    {"offset_up_mm", Better::kNearerZero, 8},
    {"leg_length_percent", Better::kNearerZero, 0.5},
    {"speed_error_m_s", Better::kNearerZero, 0.02},
    {"angle_heading_bias_deg", Better::kNearerZero, 2},
    {"angle_lknee_flexion_bias_deg", Better::kNearerZero, 3},
    {"angle_rknee_flexion_bias_deg", Better::kNearerZero, 3},
    {"foot_slide_mean_mm", Better::kLower, 10},
    {"penetration_mm", Better::kLower, 10},
    {"jitter_m_s3", Better::kLower, 200},
    {"coverage90_percent", Better::kHigher, 2},
    {"log_evidence", Better::kHigher, 1, 0.1},
};

// The value that a run has for a key; NaN where it has none.
double value_of(const FigureValues& values, const std::string& key) {
  const auto found = values.find(key);
  return found == values.end() ? kNone : found->second;
}

std::vector<double> over_runs(const std::vector<FigureValues>& runs, const std::string& key) {
  std::vector<double> out;
  for (const FigureValues& run : runs) out.push_back(value_of(run, key));
  return out;
}

bool any_nan(const std::vector<double>& values) {
  return std::any_of(values.begin(), values.end(), [](double v) { return std::isnan(v); });
}

double median_of_first(std::vector<double> values, size_t count) {
  values.resize(count);
  return quantile(std::move(values), 0.5);
}

Band band_from(const std::string& scene, const WatchedFigure& figure,
               const std::vector<double>& values) {
  std::vector<double> sorted = values;
  std::sort(sorted.begin(), sorted.end());
  const double median = quantile(sorted, 0.5);
  const double compared = median_of_first(values, kComparedSeeds);
  const double floor = figure.floor + figure.share * std::abs(median);
  const double half = floor + kDeviations * (sorted.at(5) - sorted.at(1)) / kInnerRange;
  Band band{scene, std::string(figure.key), std::min(median - half, compared - floor), median,
            std::max(median + half, compared + floor)};
  switch (figure.better) {
    case Better::kLower:
      band.low = -kInfinity;
      break;
    case Better::kHigher:
      band.high = kInfinity;
      break;
    case Better::kNearerZero:
      band.low = std::min(band.low, -floor);
      band.high = std::max(band.high, floor);
      break;
  }
  return band;
}

std::string number(double value) {
  if (std::isinf(value)) return "";
  const std::string text = fmt::format("{:.2f}", value);
  return text == "-0.00" ? "0.00" : text;
}

std::string interval(const Band& band) {
  return fmt::format("{} [{}, {}]", number(band.median),
                     std::isinf(band.low) ? "-∞" : number(band.low),
                     std::isinf(band.high) ? "∞" : number(band.high));
}

const Band* find(const std::vector<Band>& bands, const Band& like) {
  const auto found = std::find_if(bands.begin(), bands.end(), [&](const Band& band) {
    return band.scene == like.scene && band.key == like.key;
  });
  return found == bands.end() ? nullptr : &*found;
}

bool holds(const Band& band, double value) { return value >= band.low && value <= band.high; }

}  // namespace

std::span<const WatchedFigure> watched_figures() { return kWatched; }

std::vector<Band> bands_from(const SuiteValues& values) {
  std::vector<Band> out;
  for (const auto& [scene, runs] : values) {
    if (runs.size() != kBandSeeds) throw UsageError("a band is made from seven runs");
    for (const WatchedFigure& figure : kWatched) {
      const std::vector<double> found = over_runs(runs, std::string(figure.key));
      if (!any_nan(found)) out.push_back(band_from(scene, figure, found));
    }
  }
  return out;
}

std::string bands_csv(const std::vector<Band>& bands) {
  std::string out =
      "# Written by scripts/refresh_bands.sh; what it means: tests/regression/README.md\n"
      "scene,figure,low,median,high\n";
  for (const Band& band : bands)
    out += fmt::format("{},{},{},{},{}\n", band.scene, band.key, number(band.low),
                       number(band.median), number(band.high));
  return out;
}

std::vector<Band> read_bands(const std::filesystem::path& path) {
  const CsvTable table = read_csv(path);
  const size_t scene = table.column("scene"), figure = table.column("figure");
  const size_t low = table.column("low"), high = table.column("high");
  const size_t median = table.column("median");
  std::vector<Band> out;
  for (const CsvTable::Row& row : table.rows)
    out.push_back({row.cells[scene], row.cells[figure],
                   table.optional_number(row, low).value_or(-kInfinity), table.number(row, median),
                   table.optional_number(row, high).value_or(kInfinity)});
  return out;
}

std::vector<std::string> out_of_bands(const std::vector<Band>& bands, const std::string& scene,
                                      const std::vector<FigureValues>& runs) {
  std::vector<std::string> out;
  for (const Band& band : bands) {
    if (band.scene != scene) continue;
    const std::vector<double> found = over_runs(runs, band.key);
    const double value = any_nan(found) ? kNone : quantile(found, 0.5);
    if (!holds(band, value))
      out.push_back(
          fmt::format("{} {} = {:.2f}, its band is {}", scene, band.key, value, interval(band)));
  }
  return out;
}

std::string bands_difference(const std::vector<Band>& before, const std::vector<Band>& after) {
  std::string rows;
  const auto row = [&](const Band& of, const Band* old, const Band* now, const char* remark) {
    rows += fmt::format("| {} | {} | {} | {} | {} |\n", of.scene, of.key,
                        old ? interval(*old) : "-", now ? interval(*now) : "-", remark);
  };
  for (const Band& now : after) {
    const Band* old = find(before, now);
    if (!old) {
      row(now, nullptr, &now, "new");
    } else if (interval(*old) != interval(now)) {
      row(now, old, &now, holds(*old, now.median) ? "" : "**outside the old band**");
    }
  }
  for (const Band& old : before) {
    if (!find(after, old)) row(old, &old, nullptr, "gone");
  }
  if (rows.empty()) return "No band has changed.\n";
  return "| scene | figure | old: median [band] | new: median [band] | |\n|---|---|---|---|---|\n" +
         rows;
}

}  // namespace walktrack
