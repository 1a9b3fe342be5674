#include "jobs/compare/compare_trials.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/errors.h"
#include "io/archive/files.h"
#include "io/archive/result_folder.h"
#include "jobs/track/report/report_curves.h"
#include "metrics/cycle_curve.h"
#include "metrics/statistics/mean_difference.h"

namespace walktrack {
inline namespace jobs {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();
constexpr size_t kMaxJsonBytes = size_t{1} << 28;
// Distance between the 5 and 95 % quantiles of a normal distribution in standard deviations.
constexpr double kBandInSd = 3.29;
constexpr size_t kContactParameters = 9, kAnglesWithRange = 3;

Json read_json(const fs::path& file) {
  Json json = Json::parse(read_text_file(file, kMaxJsonBytes), nullptr, false);
  if (json.is_discarded())
    throw InputError(describe({file.string(), 0, ""}, "no JSON", "what walktrack wrote"));
  return json;
}

double number_of(const Json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_number() ? found->get<double>() : kMissing;
}

size_t side_index(const Json& object) { return object.at("side") == "left" ? 0 : 1; }

// The strides between the foot strikes in gait.json.
std::vector<Stride> strides_in(const Json& gait) {
  Gait events;
  for (const Json& event : gait.at("events")) {
    const Side side = side_index(event) == 0 ? Side::kLeft : Side::kRight;
    const auto kind =
        event.at("event") == "foot_strike" ? GaitEventKind::kFootStrike : GaitEventKind::kToeOff;
    events.events.push_back({number_of(event.at("time_s"), "value"), side, kind});
  }
  return strides_of(events);
}

// A number of a contact; cadence is that of the step that ends with it.
double contact_value(const Json& contact, size_t parameter) {
  const std::string name(kComparedParameters[parameter].name);
  if (name == "cadence_steps_per_min") return 60 / number_of(contact.at("step_time_s"), "value");
  return number_of(contact.at(name), "value");
}

void take_contacts(const Json& gait, ComparedTrial& trial) {
  for (const Json& contact : gait.at("contacts")) {
    SideStrides& side = trial.sides[side_index(contact)];
    for (size_t k = 0; k < kContactParameters; ++k) {
      const double value = contact_value(contact, k);
      if (std::isfinite(value)) side.values[k].push_back(value);
    }
  }
  for (const char* name : {"left", "right"}) {
    const Json& summary = gait.at("summary").at(name);
    SideStrides& side = trial.sides[std::string_view(name) == "left" ? 0 : 1];
    for (size_t k = 0; k < kContactParameters; ++k) {
      const Json& band = summary.at(std::string(kComparedParameters[k].name));
      side.band_sd[k] = (number_of(band, "p95") - number_of(band, "p05")) / kBandInSd;
    }
  }
}

// The mean width of the band over the strides, converted to a standard deviation.
double band_sd(const Signal& signal, const std::vector<Stride>& strides) {
  double sum = 0;
  size_t count = 0;
  for (const Stride& stride : strides) {
    if (stride.side != signal.side) continue;
    const CycleCurve low = over_stride(signal.time, signal.p05, stride),
                     high = over_stride(signal.time, signal.p95, stride);
    for (size_t i = 0; i < kCyclePoints; ++i) {
      if (!std::isfinite(high[i] - low[i])) continue;
      sum += (high[i] - low[i]) / kBandInSd;
      ++count;
    }
  }
  return count > 0 ? sum / static_cast<double>(count) : kMissing;
}

void take_angle(const Signal& signal, size_t angle, const std::vector<Stride>& strides,
                SideStrides& side) {
  for (const Stride& stride : strides) {
    if (stride.side != signal.side) continue;
    const CycleCurve curve = over_stride(signal.time, signal.value, stride);
    if (std::none_of(curve.begin(), curve.end(), [](double v) { return !std::isfinite(v); }))
      side.curves[angle].emplace_back(curve.begin(), curve.end());
  }
  if (angle >= kAnglesWithRange) return;
  const size_t range = kContactParameters + 2 * angle, greatest = range + 1;
  for (const auto& curve : side.curves[angle]) {
    const auto [low, high] = std::minmax_element(curve.begin(), curve.end());
    side.values[range].push_back(*high - *low);
    side.values[greatest].push_back(*high);
  }
  side.band_sd[greatest] = band_sd(signal, strides);
  side.band_sd[range] = std::sqrt(2.0) * side.band_sd[greatest];
}

size_t angle_index(const std::string& name) {
  const auto found = std::find_if(kComparedAngles.begin(), kComparedAngles.end(),
                                  [&](const ComparedAngle& angle) { return angle.name == name; });
  return static_cast<size_t>(found - kComparedAngles.begin());
}

bool is_result(const fs::path& folder) {
  return fs::is_regular_file(folder / kRunFile) && fs::is_regular_file(folder / "angles.csv");
}

// The reason why a folder does not contain a complete result.
std::string missing_in(const fs::path& folder) {
  if (!fs::exists(folder)) return "no such folder";
  if (!fs::is_directory(folder)) return "a file";
  if (fs::is_regular_file(folder / "run.partial.json")) return "an incomplete result";
  return "no complete result, nor one below it";
}

std::vector<fs::path> results_in(const fs::path& place) {
  if (is_result(place)) return {place};
  std::vector<fs::path> found;
  std::error_code unreadable;
  for (auto entry = fs::recursive_directory_iterator(
           place, fs::directory_options::skip_permission_denied, unreadable);
       !unreadable && entry != fs::end(entry); entry.increment(unreadable)) {
    if (entry->is_directory() && is_result(entry->path())) found.push_back(entry->path());
  }
  if (found.empty())
    throw InputError(describe({place.string(), 0, ""}, missing_in(place),
                              "results of 'walktrack track', 'analyse' or 'batch'"));
  std::sort(found.begin(), found.end());
  return found;
}

std::string folder_name(const fs::path& folder) {
  const fs::path whole = fs::absolute(folder).lexically_normal();
  return (whole.has_filename() ? whole.filename() : whole.parent_path().filename()).string();
}

}  // namespace

ComparedTrial read_trial(const fs::path& folder) {
  const Json run = read_json(folder / kRunFile), gait = read_json(folder / "gait.json");
  ComparedTrial trial{folder, folder_name(folder), run.value("status", ""), {}, {}};
  for (SideStrides& side : trial.sides) side.band_sd.fill(kMissing);
  try {
    for (const Json& measure : run.value("quality", Json::array()))
      if (!measure.value("passed", true)) trial.failed.push_back(measure.value("what", ""));
    take_contacts(gait, trial);
    const std::vector<Stride> strides = strides_in(gait);
    for (const Signal& signal : angle_signals(folder))
      take_angle(signal, angle_index(signal.name), strides,
                 trial.sides[signal.side == Side::kLeft ? 0 : 1]);
  } catch (const Json::exception&) {
    throw InputError(describe({(folder / "gait.json").string(), 0, ""}, "other contents",
                              "what this version of walktrack writes: analyse its joints.csv"));
  }
  return trial;
}

ComparedGroup read_group(const CompareGroup& group) {
  ComparedGroup out{group.name.empty() ? folder_name(group.places.at(0)) : group.name, {}};
  for (const fs::path& place : group.places)
    for (const fs::path& folder : results_in(place)) out.trials.push_back(read_trial(folder));
  return out;
}

}  // namespace jobs
}  // namespace walktrack
