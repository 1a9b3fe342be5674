// The quality of a track, as far as it shows without a truth: numbers, each with the limit of the
// configuration that it must not exceed.
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

// Somebody moves in a frame in which this much of a picture is newly covered (FrameRecord::moving):
// a quarter of what a walker covers in that time.
inline constexpr double kSomebodyMoves = 0.15;  // m^2

// What any motion shows, without limits: feet, ground and trembling are judged by
// metrics/plausibility.h, swapped legs by metrics/leg_swaps.h. `rate` in Hz.
// `leg`: the subject's leg length, m.
Quality quality_of_motion(const Motion& motion, double rate, double leg);

// The same of a track with its limits, after what was lost, in the order that they are shown in.
// `moving`: the frames before their feet were planted; the limits on feet are for those, for
// planted ones tell little of a track that fails.
Quality quality_of(const TrackedFrames& frames, const TrackedFrames& moving,
                   const QualityConfig& limits, double leg);

// In how many of the frames with keypoints the figure is on one of the people detected; nullopt
// if there are too few of them.
std::optional<QualityMeasure> quality_of_keypoints(const KeypointUse& use,
                                                   const QualityConfig& limits);

// By camera, the mean over the frames that tell of how well the figure lies on the person
// (FigureFit::overlap); NaN for a camera that tells nothing.
std::vector<double> mean_overlaps(const TrackedFrames& frames);

Quality failures(const Quality& quality);

// What a failed check says: the measure, its value and what is allowed.
std::string failure_text(const QualityMeasure& failed);

// What the first failed check says against the result; empty if all passed.
std::string first_failure(const Quality& quality);

}  // namespace jobs
}  // namespace walktrack
