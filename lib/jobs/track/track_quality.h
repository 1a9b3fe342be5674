// How good a track is, as far as it can tell itself: numbers that people ask for, each with the
// gate of the configuration that it has to pass.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/archive/run_record.h"
#include "io/config/config.h"
#include "jobs/track/track_results.h"

namespace walktrack {

using Quality = std::vector<QualityMeasure>;

// What any motion shows, without gates: feet, ground and trembling are judged by
// metrics/plausibility.h, swapped legs by metrics/leg_swaps.h. `rate` in Hz.
Quality quality_of_motion(const Motion& motion, double rate);

// The same of a track with its gates, after what was lost, in the order that they are shown in.
// `moving`: the frames before their feet were planted; the gates on feet are for those, for planted
// ones tell little of a track that fails.
Quality quality_of(const TrackedFrames& frames, const TrackedFrames& moving,
                   const GateConfig& gates);

// What the first failed gate says against the result; empty if all passed.
std::string first_failure(const Quality& quality);

}  // namespace walktrack
