// The quality of a track as far as it can be measured without a truth: numbers, each with the limit
// that the configuration states.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/archive/run_record.h"
#include "io/config/config.h"
#include "jobs/track/results/track_results.h"
#include "observation/keypoints/keypoint_term.h"

namespace walktrack {
inline namespace jobs {

using Quality = std::vector<QualityMeasure>;

// A frame contains motion if this much of an image is newly covered (FrameRecord::moving): a
// quarter of what a walking person covers in that time.
inline constexpr double kSomebodyMoves = 0.15;  // m^2

// Number of frames without a figure in which nobody can be tracked: the figure has left every
// picture, and nobody moves.
int frames_out_of_picture(const TrackedFrames& frames);

// The measures of any motion, without limits: feet, ground and jitter are measured by
// metrics/plausibility.h, swapped legs by metrics/leg_swaps.h. `rate` in Hz. `leg`: the subject's
// leg length, m.
Quality quality_of_motion(const Motion& motion, double rate, double leg);

// The measures of a track with their limits, in the order in which they are shown, beginning with
// lost frames. `moving`: the frames before their feet were planted. The limits on feet apply to
// those, because planted feet hide the errors of a track that fails. Frames out of the picture
// are not lost.
Quality quality_of(const TrackedFrames& frames, const TrackedFrames& moving,
                   const QualityConfig& limits, double leg);

// The share of the frames with keypoints in which the figure agrees with a detected person; nullopt
// if there are too few such frames.
std::optional<QualityMeasure> quality_of_keypoints(const KeypointUse& use,
                                                   const QualityConfig& limits);

Quality failures(const Quality& quality);

// The message for a failed check: the measure, its value and what is allowed.
std::string failure_text(const QualityMeasure& failed);

// The message of the first failed check; empty if all passed.
std::string first_failure(const Quality& quality);

}  // namespace jobs
}  // namespace walktrack
