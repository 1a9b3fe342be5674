// The time of a step, from the vertical motion of a walking figure.
#pragma once

#include <optional>
#include <vector>

namespace walktrack {
inline namespace observation {

// The time of a step, s. Heights by frame, for example of the head (any unit; NaN if unknown), rise
// and fall once in each step, in addition to slow changes as somebody comes nearer. nullopt if
// nothing repeats within the possible times of steps.
std::optional<double> step_time(const std::vector<double>& heights, double frame_rate);

// Whether a time is that of one or more whole steps, within the accuracy of the estimate.
bool is_whole_steps(double time, double step);

}  // namespace observation
}  // namespace walktrack
