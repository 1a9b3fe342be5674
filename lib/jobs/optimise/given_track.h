// The frames of somebody else's track, as the tracker's own records: the pose that fits the given
// joints (tracker/smooth/joint_fit.h) in the place of the particles' mean, and what the images of
// the frame, if there are any, say about the pose around it (tracker/smooth/refinement.h).
#pragma once

#include "core/job_control.h"
#include "io/archive/result_folder.h"
#include "io/video/scene_video.h"
#include "jobs/track/results/track_results.h"
#include "jobs/track/track.h"

namespace walktrack {
inline namespace jobs {

struct GivenTrack {
  BodyModel model;
  TrackedFrames frames;
};

// By how much the floor of a motion is too high, m: the median height of its ankles while soles are
// flat, less that of the body's ankle. 0 if no sole is seen flat.
double floor_height(const Motion& motion, const Subject& subject);

// `motion`: the given joints at the times of the frames; frames without hips, knees and ankles are
// not tracked. `joint_sd`: of a given joint, m. The records lie in the folder's kFramesFile.
GivenTrack given_track(const Motion& motion, const Subject& subject, double rate, double joint_sd,
                       const Config& config, const ResultFolder& folder);
// The same with the images of a scene, whose subject is `job.scene.subject`. Frames that the motion
// has not are not tracked. Stops early if the control says so.
GivenTrack given_track(const Motion& motion, const TrackJob& job, SceneVideo& video,
                       double joint_sd, const ResultFolder& folder, const JobControl& control);

}  // namespace jobs
}  // namespace walktrack
