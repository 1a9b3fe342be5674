// A frame's pose in its own right: the most probable one near what the particles say.
//
// Particles are walkers, and people's poses stray from walkers' further than some hundred particles
// can follow in sixteen numbers at once. So the pose that is reported is let free of the walker:
// every number of it is normal about the particles' mean, as far as people may stray (sizes in
// refinement.cpp, set by hand), and the frame's silhouettes decide (filter/map_estimate.h). Where
// they say nothing, as while legs are hidden, the walker's word stands. The particles themselves
// are left alone: what tells left from right, and what comes next, is theirs.
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
