// The girth of the subject, from the outlines of a start before one camera.
//
// The height is stated or estimated, but not how wide somebody is: a figure that is too thin
// explains the outlines of a wide person best where it is too near, or crouches. With the poses
// that a start has found, the outlines of people of known girth are explained best at about their
// girth (tracker/reports/girth.md). From the front arms, which the figure lacks, count as trunk;
// therefore only walks across the camera's ray are used.
#pragma once

#include <optional>

#include "tracker/figure/figure_comparison.h"

namespace walktrack {
inline namespace tracker {

// Standard deviation of such a girth, from people rendered here (tracker/reports/girth.md).
inline constexpr double kGirthSd = 0.06;

// The girth (Subject::girth) at which the figures of a start's poses explain the outlines best, if
// it is larger than that of the scene's body; nullopt otherwise, and if the subject faces the
// camera or turns their back on it. The poses of a figure that is too thin show less than the
// girth, so that the next start shows more.
std::optional<double> larger_girth(const StartPoses& start);

// Who is less wide than this in the end is tracked with the figure of a usual girth: the least that
// leaves a real woman of usual girth alone, whose feet slide otherwise (tracker/reports/girth.md).
inline constexpr double kClearlyWide = 1.22;

// The same person with that girth.
Body with_girth(const Body& body, double girth);

}  // namespace tracker
}  // namespace walktrack
