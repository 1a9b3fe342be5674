// The time of a step, from the rise and fall of a walking figure.
#pragma once

#include <optional>
#include <vector>

namespace walktrack {
inline namespace observation {

// The time of a step, s: heights of the head, say, by frame (any unit; NaN where not known) rise
// and fall once a step, on top of what changes slowly as somebody comes nearer. nullopt where
// nothing of the kind repeats itself within the times that steps take.
std::optional<double> step_time(const std::vector<double>& heights, double frame_rate);

// Whether a time is that of one or more whole steps, as near as can be told.
bool is_whole_steps(double time, double step);

}  // namespace observation
}  // namespace walktrack
