// The speed of a stage of a job, and the times at which it is reported.
#pragma once

#include <chrono>
#include <string>

#include "core/job_control.h"

namespace walktrack {

class ProgressPace {
 public:
  using Clock = std::chrono::steady_clock;

  // At most one report every `interval`. The first report of a stage is made at once or, with
  // `patient`, only after the interval; the last one of a stage is always made, of a patient one
  // only if there was a report before.
  explicit ProgressPace(Clock::duration interval, bool patient = false)
      : interval_(interval), patient_(patient) {}

  // Records the progress; returns whether it should be reported now.
  bool due(const Progress& progress, Clock::time_point now);

  // Of the last progress; 0 = unknown yet.
  double per_second() const { return per_second_; }
  // NaN = unknown.
  double seconds_left() const { return seconds_left_; }
  // Whether the last progress began a new stage.
  bool new_stage() const { return new_stage_; }

 private:
  Clock::duration interval_;
  bool patient_, new_stage_ = false, said_ = false;
  std::string what_;
  Clock::time_point start_, last_;
  size_t done_before_ = 0;  // at start_
  double per_second_ = 0, seconds_left_ = 0;
};

// "45 s", "12 min", "3 h 20 min".
std::string duration_text(double seconds);

// "tracking 41/84  12.3/s  3 s left", with `bar` before the numbers.
std::string progress_text(const Progress& progress, const ProgressPace& pace,
                          const std::string& bar = "");

// {"event": "progress", "what", "done", "total", "per_second", "seconds_left"}; null: unknown.
std::string progress_json(const Progress& progress, const ProgressPace& pace);
// {"event": "message", "text"} or {"event": "error", "exit", "text"}.
std::string message_json(std::string_view text);
std::string error_json(std::string_view text, int exit_code);
// The result line of a command that ended with an error: {"format": "walktrack result 1",
// "command", "status": "error", "exit", "trouble"}.
std::string failed_result_json(std::string_view command, std::string_view trouble, int exit_code);

}  // namespace walktrack
