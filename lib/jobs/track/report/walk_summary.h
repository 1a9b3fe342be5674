// The most important results of a track, as lines for the terminal and as one line of JSON for
// programs.
#pragma once

#include <string>
#include <vector>

#include "io/archive/run_record.h"
#include "metrics/gait_table.h"

namespace walktrack {
inline namespace jobs {

struct TrackOutcome;

// Four numbers of a walk, as in gait.json. NaN: unknown.
struct WalkSummary {
  size_t steps = 0;    // steps whose length is known
  Banded speed;        // m/s
  Banded cadence;      // steps per minute
  Banded step_length;  // m
};
WalkSummary walk_summary(const GaitTable& table);

// Text lines: frames and speed of computation, the four numbers with their bands, failed quality
// checks with advice, and the page to open.
std::string summary_text(const TrackOutcome& outcome);

// {"format": "walktrack result 1", "command": "track", "status", "exit", "result", "open",
//  "frames", "tracked_frames", "frames_per_second", "steps", "speed_m_s", "cadence_steps_per_min",
//  "step_length_m", "failed_checks", "resumable", "trouble"} in one line; numbers as {"value",
// "p05", "p95"}, null where there is none.
std::string summary_json(const TrackOutcome& outcome, const std::string& result, int exit_code);

}  // namespace jobs
}  // namespace walktrack
