// Standing before a walk: most recordings begin with a subject who stands and then sets off.
#pragma once

#include <functional>
#include <optional>

#include "tracker/detect/detected_walk.h"
#include "tracker/detect/detector_config.h"
#include "tracker/state/particle.h"

namespace walktrack {
inline namespace tracker {

// Somebody who stands has the same outline in every frame, and what is wrong with it (clothes,
// arms, a body that is wider than the figure) does not average out as it does while they walk.
// Where keypoints lead, whose errors change from frame to frame, the outlines of these frames count
// for so much; reports/standing.md has the measurement.
inline constexpr double kStillOutlines = 0.1;

// That body on straight legs, with the root above the origin and heading 0.
Pose standing_pose(const BodyModel& model);

// Score in nats of a figure that stands over a ground point and faces a heading, `back` frames
// before the walk begins (1 is the frame before); nullopt if there is no such frame.
using StandingScore =
    std::function<std::optional<double>(size_t back, const Eigen::Vector2d& place, double heading)>;

struct StandingStart {
  DetectedWalk detected;  // the place, and the direction in which the walk will go
  size_t frames = 0;      // before the walk begins
  double score = 0;       // nats, of all these frames
};

// Where the subject stood before the walk, and for how many frames without a gap; nullopt if nobody
// stood. Frames are `dt` s apart.
std::optional<StandingStart> standing_before(const DetectedWalk& walk, const StandingScore& score,
                                             double dt, const DetectorConfig& config);

}  // namespace tracker
}  // namespace walktrack
