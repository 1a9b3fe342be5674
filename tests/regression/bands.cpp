#include "tests/regression/bands.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "core/errors.h"
#include "io/tables/csv.h"
#include "metrics/statistics/statistics.h"

namespace walktrack {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kDeviations = 3;

// Expected difference of the eighth and the second smallest of nine standard normal values
// (Teichroew, Annals of Mathematical Statistics 27, 1956).
constexpr double kInnerRange = 2 * 0.9323;

constexpr WatchedFigure kWatched[] = {
    {"filled_percent", Better::kHigher, 0.05, 0, 100},
    {"joint_error_mean_mm", Better::kLower, 0.15, 0, kInfinity, kNotDoubled},
    {"joint_error_relative_mm", Better::kLower, 0.15, 0, kInfinity, kNotDoubled},
    {"joint_error_procrustes_mm", Better::kLower, 0.15, 0, kInfinity, kNotDoubled},
    {"swapped_percent", Better::kLower, 0.2, 0, 100},
    {"offset_along_mm", Better::kNearerZero, 0.2},
    {"offset_left_mm", Better::kNearerZero, 0.2},
    {"offset_up_mm", Better::kNearerZero, 0.2},
    {"leg_length_percent", Better::kNearerZero, 0.2},
    {"angle_heading_bias_deg", Better::kNearerZero, 0.2, -180, 180},
    {"hip_rms_deg", Better::kLower, 0.15, 0, 180, kNotDoubled},
    {"knee_rms_deg", Better::kLower, 0.15, 0, 180, kNotDoubled},
    {"ankle_rms_deg", Better::kLower, 0.15, 0, 180, kNotDoubled},
    {"angle_lknee_flexion_bias_deg", Better::kNearerZero, 0.2, -180, 180},
    {"angle_rknee_flexion_bias_deg", Better::kNearerZero, 0.2, -180, 180},
    {"speed_error_m_s", Better::kNearerZero, 0.2},
    {"step_length_error_m", Better::kNearerZero, 0.2},
    {"step_time_error_s", Better::kNearerZero, 0.2},
    {"event_error_ms", Better::kLower, 0.2, 0},
    {"event_late_ms", Better::kNearerZero, 0.2},
    {"events_missed", Better::kLower, 0.2, 0},
    {"events_extra", Better::kLower, 0.2, 0},
    {"foot_slide_mean_mm", Better::kLower, 0.2, 0},
    {"penetration_mm", Better::kLower, 0.2, 0},
    {"jitter_m_s3", Better::kLower, 0.2, 0},
    {"coverage90_percent", Better::kNeither, 0.05, 0, 100},
    {"interval_width_mm", Better::kNeither, 0.15, 0, kInfinity, kNotDoubled},
    {"log_evidence", Better::kNeither, 0.1},
    // Of clips whose reference is no motion.
    {"passed", Better::kHigher, 0, 0, 1},
    {"tracked_percent", Better::kHigher, 0.05, 0, 100},
    {"first_tracked_s", Better::kLower, 0.2, 0},
    {"plants_found", Better::kHigher, 0, 0},
    {"plant_error_mean_mm", Better::kLower, 0.2, 0, kInfinity, kNotDoubled},
    {"toes_on_side", Better::kHigher, 0, 0},
    {"toe_error_mean_mm", Better::kLower, 0.2, 0, kInfinity, kNotDoubled},
    {"events_in_standing", Better::kLower, 0.2, 0},
    {"standing_percent", Better::kHigher, 0.05, 0, 100},
    {"invented_steps", Better::kLower, 0.2, 0},
    {"invented_walks", Better::kLower, 0, 0, 1},
    {"ground_error_median_mm", Better::kLower, 0.2, 0, kInfinity, kNotDoubled},
    {"ground_error_p95_mm", Better::kLower, 0.2, 0},
    {"speed_m_s", Better::kNeither, 0.1, 0},
    {"step_length_m", Better::kNeither, 0.1, 0},
    {"step_time_s", Better::kNeither, 0.1, 0},
};

// The value of a run for a key; NaN if it has none.
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

// Half of the distance between two standard deviations on either side of the seeds' values.
double deviation(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return (values.at(kBandSeeds - 2) - values.at(1)) / kInnerRange;
}

// A share of the median; for a quantity with two signs, of its usual magnitude.
double floor_of(const WatchedFigure& figure, std::vector<double> values) {
  for (double& value : values) value = std::abs(value);
  return figure.share * quantile(std::move(values), 0.5);
}

Band band_from(const std::string& scene, const WatchedFigure& figure,
               const std::vector<double>& values) {
  const double median = quantile(values, 0.5);
  const double compared = median_of_first(values, kComparedSeeds);
  const double half = floor_of(figure, values) + kDeviations * deviation(values);
  const double most = std::isfinite(figure.most_growth) ? figure.most_growth * median : kInfinity;
  const double low = std::min(median - half, compared);
  const double high = std::max(std::min(median + half, most), compared);
  Band band{scene, std::string(figure.key), low, median, high, median};
  if (figure.better == Better::kLower) band.low = -kInfinity;
  if (figure.better == Better::kHigher) band.high = kInfinity;
  if (figure.better == Better::kNearerZero) {
    band.low = std::min(band.low, -half);
    band.high = std::max(band.high, half);
  }
  band.low = std::max(band.low, figure.least);
  band.high = std::min(band.high, figure.most);
  return band;
}

// A band that nothing can leave watches nothing.
bool can_be_left(const Band& band, const WatchedFigure& figure) {
  return band.low > figure.least || band.high < figure.most;
}

Better better_of(const std::string& key) {
  for (const WatchedFigure& figure : kWatched)
    if (figure.key == key) return figure.better;
  return Better::kNeither;
}

// How much worse the first value is than the second; negative: better.
double worse_by(Better better, double value, double than) {
  switch (better) {
    case Better::kLower:
      return value - than;
    case Better::kHigher:
      return than - value;
    case Better::kNearerZero:
      return std::abs(value) - std::abs(than);
    case Better::kNeither:
      break;
  }
  return 0;
}

// From its median to its worse end.
double reach(const Band& band) {
  const Better better = better_of(band.key);
  const bool low_is_worse =
      better == Better::kHigher || (better == Better::kNearerZero && band.median < 0);
  return low_is_worse ? band.median - band.low : band.high - band.median;
}

bool is_worse(const Band& band) {
  return worse_by(better_of(band.key), band.median, band.best) > reach(band);
}

std::string number(double value) {
  if (std::isinf(value)) return "";
  const std::string text = fmt::format("{:.4g}", value);
  return text == "-0" ? "0" : text;
}

// Four digits of an end of a band, outwards, so that the band holds what it was made from. A number
// that has four digits stays.
double outwards(double value, double direction) {
  if (value == 0 || std::isinf(value)) return value;
  constexpr double kSame = 1e-6;
  const double scale = std::pow(10, 3 - std::floor(std::log10(std::abs(value))));
  return direction * std::ceil(direction * value * scale - kSame) / scale;
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
    if (runs.size() != kBandSeeds) throw UsageError("a band is made from nine runs");
    for (const WatchedFigure& figure : kWatched) {
      const std::vector<double> found = over_runs(runs, std::string(figure.key));
      if (any_nan(found)) continue;
      const Band band = band_from(scene, figure, found);
      if (can_be_left(band, figure)) out.push_back(band);
    }
  }
  return out;
}

std::string bands_csv(const std::vector<Band>& bands) {
  std::string out =
      "# Written by scripts/refresh_bands.sh; what it means: tests/regression/README.md\n"
      "scene,figure,low,median,high,best\n";
  for (const Band& band : bands)
    out += fmt::format("{},{},{},{},{},{}\n", band.scene, band.key, number(outwards(band.low, -1)),
                       number(band.median), number(outwards(band.high, 1)), number(band.best));
  return out;
}

std::vector<Band> read_bands(const std::filesystem::path& path) {
  const CsvTable table = read_csv(path);
  const size_t scene = table.column("scene"), figure = table.column("figure");
  const size_t low = table.column("low"), high = table.column("high");
  const size_t median = table.column("median"), best = table.column("best");
  std::vector<Band> out;
  for (const CsvTable::Row& row : table.rows)
    out.push_back({row.cells[scene], row.cells[figure],
                   table.optional_number(row, low).value_or(-kInfinity), table.number(row, median),
                   table.optional_number(row, high).value_or(kInfinity), table.number(row, best)});
  return out;
}

std::vector<Band> with_best(std::vector<Band> now, const std::vector<Band>& before) {
  for (Band& band : now) {
    const Band* old = find(before, band);
    if (old && worse_by(better_of(band.key), band.best, old->best) > 0) band.best = old->best;
  }
  return now;
}

std::vector<Excuse> read_excuses(const std::filesystem::path& path) {
  const CsvTable table = read_csv(path);
  const size_t scene = table.column("scene"), figure = table.column("figure");
  const size_t why = table.column("why");
  std::vector<Excuse> out;
  for (const CsvTable::Row& row : table.rows) {
    if (row.cells[why].empty()) throw InputError(path.string() + ": an excuse without a reason");
    out.push_back({row.cells[scene], row.cells[figure]});
  }
  return out;
}

std::vector<std::string> unexcused(const std::vector<Band>& bands,
                                   const std::vector<Excuse>& excuses) {
  std::vector<std::string> out;
  std::vector<const Band*> worse;
  for (const Band& band : bands)
    if (is_worse(band)) worse.push_back(&band);
  const auto same = [](const Band& band, const Excuse& excuse) {
    return band.scene == excuse.scene && band.key == excuse.key;
  };
  for (const Band* band : worse) {
    if (std::any_of(excuses.begin(), excuses.end(),
                    [&](const Excuse& e) { return same(*band, e); }))
      continue;
    out.push_back(fmt::format("{} {} = {}, it once was {}: say why in worse.csv", band->scene,
                              band->key, number(band->median), number(band->best)));
  }
  for (const Excuse& excuse : excuses) {
    if (std::any_of(worse.begin(), worse.end(), [&](const Band* b) { return same(*b, excuse); }))
      continue;
    out.push_back(fmt::format("{} {} is not worse than it was: take it out of worse.csv",
                              excuse.scene, excuse.key));
  }
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
      out.push_back(fmt::format("{} {} = {}, its band is {}", scene, band.key, number(value),
                                interval(band)));
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
