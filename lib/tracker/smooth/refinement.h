// The most probable pose of a frame, near the particles' mean.
//
// Particles are walkers, and the poses of people differ from those of walkers in sixteen numbers at
// once, by more than some hundred particles can follow. The reported pose is therefore not bound to
// the walker: every number of it has a normal prior about the particles' mean, with the deviations
// of people (PoseNumber::spread), and the images of the frame decide (filter/map_estimate.h).
// Where they give no evidence, as while legs are hidden, the prior remains. The particles are not
// changed: they distinguish left from right and predict the next frame.
//
// tracker/reports/reported_pose.md says what it gains, and what else was tried.
#pragma once

#include "tracker/tracker_scene.h"
#include "tracker/walker_filter.h"

namespace walktrack {
inline namespace tracker {

// Moves a tracked frame's estimate there: pose, joints, bands and samples.
void refine(const TrackerScene& scene, const SceneEvidence& evidence, int threads,
            FrameRecord& record);

}  // namespace tracker
}  // namespace walktrack
