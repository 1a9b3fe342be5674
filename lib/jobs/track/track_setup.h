// From a scene and a configuration to a tracker's inputs: observers that know the empty scene, the
// subject's body, where the walk begins.
#pragma once

#include <span>
#include <vector>

#include "core/job_control.h"
#include "io/config/config.h"
#include "io/scene/scene.h"
#include "jobs/track/input/detections.h"
#include "observation/observer.h"
#include "tracker/tracker_scene.h"

namespace walktrack {
inline namespace jobs {

struct TrackSetup {
  std::vector<Observer> observers;  // by camera
  TrackerScene scene;
  Detections detections;  // of the observers' frames
};

// Learns each camera's background from its empty frames or, without them, from the video itself;
// observers that have `learned` already go on with what they know (by camera, or none).
TrackSetup set_up(const Scene& scene, const Config& config, double frame_rate,
                  std::span<const ObserverState> learned, const JobControl& control);

// How high somebody of this height who stands at a place on the ground is in an image, px; 0 where
// they are not in front of the camera.
double height_px(const Camera& camera, const Eigen::Vector2d& place, double height);

// How large a camera's images are worked on.
WorkingScale working_scale(const Scene& scene, const Camera& camera, const Config& config);

// What the search for a walk holds at a time, of all cameras: the evidence of a window of frames,
// B. It grows with the frame rate and with the pixels that are left after shrinking.
double search_window_bytes(const Scene& scene, const Config& config, double frame_rate);
inline constexpr double kMostSearchBytes = 8.0 * (1 << 30);
// InputError, with what makes it less, where that is more than kMostSearchBytes.
void require_room_for_search(const Scene& scene, const Config& config, double frame_rate);

// Where to look in the next frame: around the walker once tracked, everywhere before.
Region search_region(const Camera& camera, double subject_height);

}  // namespace jobs
}  // namespace walktrack
