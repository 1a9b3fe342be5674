#include "progress_pace.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace walktrack {

namespace {

using Json = nlohmann::ordered_json;

std::string line_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

bool ProgressPace::due(const Progress& progress, Clock::time_point now) {
  const bool complete = progress.total > 0 && progress.done >= progress.total;
  new_stage_ = progress.what != what_;
  if (new_stage_) {
    what_ = progress.what;
    start_ = last_ = now;
    done_before_ = progress.done;
    said_ = false;
  }
  const double seconds = std::chrono::duration<double>(now - start_).count();
  // Frames of an earlier run that was resumed took none of this time.
  const auto since = static_cast<double>(progress.done - std::min(progress.done, done_before_));
  per_second_ = seconds > 0 ? since / seconds : 0;
  const size_t left = progress.total - std::min(progress.done, progress.total);
  seconds_left_ = progress.total > 0 && per_second_ > 0 ? static_cast<double>(left) / per_second_
                                                        : std::numeric_limits<double>::quiet_NaN();
  const bool due = patient_ ? now - last_ >= interval_ || (complete && said_)
                            : new_stage_ || now - last_ >= interval_ || complete;
  if (!due) return false;
  last_ = now;
  said_ = true;
  return true;
}

std::string duration_text(double seconds) {
  if (seconds < 100) return fmt::format("{:.0f} s", seconds);
  const int minutes = static_cast<int>(std::lround(seconds / 60));
  return minutes < 120 ? fmt::format("{} min", minutes)
                       : fmt::format("{} h {:02d} min", minutes / 60, minutes % 60);
}

std::string progress_text(const Progress& progress, const ProgressPace& pace,
                          const std::string& bar) {
  std::string text = fmt::format("{} {}{}", progress.what, bar, progress.done);
  if (progress.total > 0)
    text = fmt::format("{} {}{}/{}", progress.what, bar, std::min(progress.done, progress.total),
                       progress.total);
  if (pace.per_second() > 0) text += fmt::format("  {:.1f}/s", pace.per_second());
  if (std::isfinite(pace.seconds_left()))
    text += fmt::format("  {} left", duration_text(pace.seconds_left()));
  return text;
}

std::string progress_json(const Progress& progress, const ProgressPace& pace) {
  Json line = {{"event", "progress"},   {"what", std::string(progress.what)},
               {"done", progress.done}, {"total", nullptr},
               {"per_second", nullptr}, {"seconds_left", nullptr}};
  if (progress.total > 0) line["total"] = progress.total;
  if (pace.per_second() > 0) line["per_second"] = pace.per_second();
  if (std::isfinite(pace.seconds_left())) line["seconds_left"] = pace.seconds_left();
  return line_of(line);
}

std::string message_json(std::string_view text) {
  return line_of({{"event", "message"}, {"text", std::string(text)}});
}

std::string error_json(std::string_view text, int exit_code) {
  return line_of({{"event", "error"}, {"exit", exit_code}, {"text", std::string(text)}});
}

std::string failed_result_json(std::string_view command, std::string_view trouble, int exit_code) {
  return line_of({{"format", "walktrack result 1"},
                  {"command", std::string(command)},
                  {"status", "error"},
                  {"exit", exit_code},
                  {"trouble", std::string(trouble)}});
}

}  // namespace walktrack
