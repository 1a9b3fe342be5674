// Standing before a walk: most recordings begin with somebody who stands and then sets off.
#pragma once

#include <optional>

#include "tracker/detect/detector.h"
#include "tracker/state/particle.h"

namespace walktrack {
inline namespace tracker {

// Somebody of that body on straight legs, the root above the origin, heading 0.
Pose standing_pose(const BodyModel& model);

// Nats of somebody who stands over a ground point and faces a heading, `back` frames before the
// walk begins, 1 being the frame before; nullopt where there is no such frame.
using StandingScore =
    std::function<std::optional<double>(size_t back, const Eigen::Vector2d& place, double heading)>;

struct StandingStart {
  DetectedWalk detected;  // where they stand, facing the way that they will go
  size_t frames = 0;      // before the walk begins
  double score = 0;       // nats, of all these frames
};

// Where somebody stood before the walk, and for how many frames without a gap; nullopt when nobody
// did. `dt` s lie between frames.
std::optional<StandingStart> standing_before(const DetectedWalk& walk, const StandingScore& score,
                                             double dt, const DetectorConfig& config);

}  // namespace tracker
}  // namespace walktrack
