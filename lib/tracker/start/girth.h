// The girth of the subject, from the outlines of a start before one camera.
//
// The height is stated or estimated, but not how wide somebody is: a figure that is too thin
// explains the outlines of a wide person best where it is too near, or crouches. The figures with
// which a walk is searched do not tell the girth, since they are not in step and have no arms; the
// poses that a start has found do: with these, the outlines of people of known girth are explained
// best at about their girth (tracker/reports/girth.md). From the front arms, which the figure
// lacks, count as trunk; therefore only walks across the camera's ray are used.
#pragma once

#include <deque>
#include <optional>
#include <span>

#include "tracker/tracker_scene.h"
#include "tracker/walker_filter.h"

namespace walktrack {
inline namespace tracker {

// Standard deviation of such a girth, from people rendered here (tracker/reports/girth.md).
inline constexpr double kGirthSd = 0.06;

// The girth (Subject::girth) at which the figures of a start's poses explain the outlines best, if
// it is larger than that of the scene's body; nullopt otherwise, and if the subject faces the
// camera or turns their back on it. The poses of a figure that is too thin show less than the
// girth, so that the next start shows more. `records`: of the first frames of `window`, before one
// camera.
std::optional<double> larger_girth(const TrackerScene& scene,
                                   const std::deque<SceneEvidence>& window,
                                   std::span<const FrameRecord> records);

// Who is less wide than this in the end is tracked with the figure of a usual girth: the least that
// leaves a real woman of usual girth alone, whose feet slide otherwise (tracker/reports/girth.md).
inline constexpr double kClearlyWide = 1.22;

// The same person with that girth.
Body with_girth(const Body& body, double girth);

}  // namespace tracker
}  // namespace walktrack
