#include "jobs/track/report/walk_summary.h"

#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "jobs/track/report/track_quality.h"
#include "jobs/track/track.h"

namespace walktrack {
inline namespace jobs {

namespace {

using Json = nlohmann::ordered_json;

// "1.16 m/s (1.13 to 1.19)"
std::string with_band(const Banded& number, int digits, std::string_view unit) {
  if (!std::isfinite(number.value)) return "not known";
  std::string text = fmt::format("{:.{}f} {}", number.value, digits, unit);
  if (std::isfinite(number.p05) && std::isfinite(number.p95))
    text += fmt::format(" ({:.{}f} to {:.{}f})", number.p05, digits, number.p95, digits);
  return text;
}

// Rounded as in gait.json.
Json or_null(double value) {
  return std::isfinite(value) ? Json(std::round(value * 1e6) / 1e6) : Json(nullptr);
}

Json json_of(const Banded& number) {
  return {
      {"value", or_null(number.value)}, {"p05", or_null(number.p05)}, {"p95", or_null(number.p95)}};
}

Json json_of(const QualityMeasure& check) {
  return {{"name", check.name},
          {"what", check.what},
          {"value", or_null(check.value)},
          {check.at_most ? "at_most" : "at_least", or_null(check.limit.value_or(NAN))},
          {"unit", check.unit},
          {"advice", check.advice}};
}

}  // namespace

WalkSummary walk_summary(const GaitTable& table) {
  return {table.steps, table.both[kSpeed], table.both[kCadence], table.both[kMeanStepLength]};
}

std::string summary_text(const TrackOutcome& outcome) {
  std::string text = fmt::format("{} of {} frames tracked, {:.1f} frames/s", outcome.tracked,
                                 outcome.frames, outcome.frames_per_second);
  if (outcome.stride_frames_per_second)
    text += fmt::format(" ({:.1f} while tracking)", *outcome.stride_frames_per_second);
  if (outcome.tracked > 0) {
    const WalkSummary& walk = outcome.walk;
    text += fmt::format("\n  steps        {}\n  speed        {}\n  cadence      {}\n", walk.steps,
                        with_band(walk.speed, 2, "m/s"), with_band(walk.cadence, 0, "steps/min"));
    text += fmt::format("  step length  {}", with_band(walk.step_length, 2, "m"));
  }
  for (const QualityMeasure& check : outcome.failed_checks) {
    text += fmt::format("\n  failed: {}", failure_text(check));
    if (!check.advice.empty()) text += fmt::format("\n    {}", check.advice);
  }
  return text + fmt::format("\n  open {}", outcome.open_first.string());
}

std::string summary_json(const TrackOutcome& outcome, const std::string& result, int exit_code) {
  Json failed = Json::array();
  for (const QualityMeasure& check : outcome.failed_checks) failed.push_back(json_of(check));
  const Json line = {
      {"format", "walktrack result 1"},
      {"command", "track"},
      {"status", status_word(outcome.status)},
      {"exit", exit_code},
      {"result", result},
      {"open", outcome.open_first.string()},
      {"frames", outcome.frames},
      {"tracked_frames", outcome.tracked},
      {"frames_per_second", or_null(outcome.frames_per_second)},
      {"stride_frames_per_second", or_null(outcome.stride_frames_per_second.value_or(NAN))},
      {"steps", outcome.walk.steps},
      {"speed_m_s", json_of(outcome.walk.speed)},
      {"cadence_steps_per_min", json_of(outcome.walk.cadence)},
      {"step_length_m", json_of(outcome.walk.step_length)},
      {"failed_checks", failed},
      {"resumable", outcome.resumable},
      {"trouble", outcome.message}};
  return line.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace jobs
}  // namespace walktrack
