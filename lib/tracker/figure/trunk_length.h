// The length of the subject's trunk, from the outlines of a start before one camera.
//
// The height is stated, but not how much of it the legs are, nor how people hold themselves: a head
// that is lower than the figure's is explained best by a figure that is farther away, with its feet
// above those of the subject. Before one camera this makes the distance wrong for the whole video.
// The poses of a start show the length nevertheless, since feet, knees and hips hold the figure:
// the same person's is found to 1 cm before other cameras and in mirrored videos
// (tracker/reports/trunk.md). Several cameras show where an outline is wrong, and are as exact
// without it.
#pragma once

#include <optional>

#include "tracker/figure/figure_comparison.h"

namespace walktrack {
inline namespace tracker {

// Standard deviation of such a length, m (tracker/reports/trunk.md).
inline constexpr double kTrunkSd = 0.015;

// The same person whose trunk has that length, m; nullopt: the usual one of the height.
Body with_trunk(const Body& body, std::optional<double> length);

// The length of the trunk (SubjectLengths::trunk) at which the figures of a start's poses explain
// the outlines best, if it clearly differs from that of the scene's body; nullopt otherwise.
std::optional<double> other_trunk(const StartPoses& start);

}  // namespace tracker
}  // namespace walktrack
