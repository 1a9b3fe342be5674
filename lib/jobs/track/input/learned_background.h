// A camera's background, from images of the empty scene or from the video itself.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/job_control.h"
#include "io/config/config.h"
#include "io/scene/scene.h"
#include "jobs/track/input/detections.h"
#include "observation/background/background.h"

namespace walktrack {
inline namespace jobs {

// Whether a camera has a video and no images of the empty scene.
bool learns_from_video(const SceneCamera& camera);

// Whether people are left out of backgrounds that are estimated from videos: as configured. `auto`
// means yes if keypoints are not off, the program has the network, and a camera without images of
// the empty scene shows people large enough for it.
bool leaves_people_out(const Scene& scene, const Config& config);

// Estimates the background. Without images of the empty scene, and as configured, people whom the
// network detects in the frames of the model are left out, whose places depend on the number of
// OpenCV's threads (observation/image_threads.h). With such images, things that the video shows
// elsewhere are those of the video (observation/background/moved_things.h), which is read from
// `first_frame` of the scene on.
BackgroundModel learned_background(const SceneCamera& camera, int first_frame, const Config& config,
                                   const WorkingScale& scale, const JobControl& control);

// The same for every camera that has a video, several of them at a time; OpenCV runs on one thread
// meanwhile.
std::vector<std::optional<BackgroundModel>> learned_backgrounds(const Scene& scene,
                                                                const Config& config,
                                                                const JobControl& control);

// What a user is told if that share of a background (BackgroundModel::from_video) is the video's.
std::string moved_things_text(double share);

}  // namespace jobs
}  // namespace walktrack
