// Prepares a tracker's inputs from a scene and a configuration: observers with the background, the
// subject's body, and the start of the walk.
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
  Detections detections;  // for the observers' frames
};

// Estimates each camera's background from frames of the empty scene or, without them, from the
// video itself. Observers that have already learned resume with the state `learned` (by camera, or
// none).
TrackSetup set_up(const Scene& scene, const Config& config, double frame_rate,
                  std::span<const ObserverState> learned, const JobControl& control);

// Updates the subject's appearance from the evidence of a frame, by camera, in which the subject
// was found like this.
void learn_appearance(const Body& body, const Pose& pose, const SceneEvidence& evidence,
                      int threads, TrackSetup& setup);

// The scale at which a camera's images are processed.
WorkingScale working_scale(const Scene& scene, const Camera& camera, const Config& config);

// UsageError if no speed is both fast and slow enough to be that of a walk.
void require_speeds_in_order(const DetectorConfig& config);

// Memory of the search for a walk, for all cameras: the evidence of a window of frames and of those
// that are kept before it, in bytes. It grows with the frame rate and with the number of pixels
// after shrinking.
double search_window_bytes(const Scene& scene, const Config& config, double frame_rate);
inline constexpr double kMostSearchBytes = 8.0 * (1 << 30);
// InputError with advice if that is more than kMostSearchBytes.
void require_room_for_search(const Scene& scene, const Config& config, double frame_rate);

// The part of the next frame that is segmented: around the subject while tracking, otherwise the
// whole image.
Region search_region(const Camera& camera, double subject_height);

}  // namespace jobs
}  // namespace walktrack
