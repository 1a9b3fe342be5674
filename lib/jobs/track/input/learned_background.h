// A camera's background, from pictures of the empty scene or from the video itself.
#pragma once

#include <string>

#include "core/job_control.h"
#include "io/config/config.h"
#include "io/scene/scene.h"
#include "jobs/track/input/detections.h"
#include "observation/background/background.h"

namespace walktrack {
inline namespace jobs {

// Whether a camera has a video and no pictures of the empty scene.
bool learns_from_video(const SceneCamera& camera);

// Whether people are left out of the backgrounds that are made of videos: as configured; `auto`
// does so where keypoints are not off, the program has the network, and a camera without pictures
// of the empty scene shows people large enough for it.
bool leaves_people_out(const Scene& scene, const Config& config);

// Learns it. Without pictures of the empty scene, and as `config` says, people are left out whom
// the network finds in the frames that the model is made of; OpenCV is on one thread meanwhile.
BackgroundModel learned_background(const SceneCamera& camera, const Config& config,
                                   const WorkingScale& scale, const JobControl& control);

}  // namespace jobs
}  // namespace walktrack
