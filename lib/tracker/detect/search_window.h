// The evidence of the frames of a window: the scores, places, lines and sizes that the detector
// (tracker/detect/detector.h) and the estimate of the height (tracker/detect/stature.h) need.
#pragma once

#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "tracker/detect/figure_places.h"
#include "tracker/detect/stature.h"
#include "tracker/subject_model.h"

namespace walktrack {
inline namespace tracker {

struct SearchWindow {
  const TrackContext& context;
  const std::deque<SceneEvidence>& frames;
  uint32_t first_frame;                      // number of the window's first
  const std::optional<LastSeen>& last_seen;  // the subject, if they were lost
  const PlaceGrid& places;                   // over which figures are tried
};

// Where the subject can be in a frame, if they were lost; nullopt: anywhere.
std::optional<Reach> reach_in_frame(const TrackContext& context,
                                    const std::optional<LastSeen>& last_seen, uint32_t frame);

// How well figures of a body explain the window's frames.
WindowScore window_score(const SearchWindow& window, const Body& body,
                         const PoseTemplates& figures);

// Places at which a subject with that body may be in a frame of the window.
std::vector<Place> places_in_frame(const SearchWindow& window, size_t index, const Body& body,
                                   const PoseTemplates& figures);

// The lines along which keypoints move at the speed of a walk.
std::vector<DetectedWalk> lines_by_keypoints(const SearchWindow& window);

// The lines past the place where the scene says that the subject is; empty if it does not say so.
LineCondition subjects_lines(const SearchWindow& window);

// The places of the cameras on the ground.
std::vector<Eigen::Vector2d> camera_positions(const TrackerScene& scene);

// The height that explains the window best near that line, which was found with figures of
// `height`. `known` as in nearest_walk.
SizedWalk sized_up(const SearchWindow& window, const DetectedWalk& walk, double height,
                   const LinePrior& known = {});

// What a scene says of the line of a walk whose start it gives.
LinePrior given_line(const TrackContext& context, const DetectedWalk& given);

// The size and the line that explain the window best. Figures of a wrong size may give a line that
// is far off, so that the line is searched with other sizes, too.
SizedWalk best_size(const SearchWindow& window, const DetectedWalk& found);

}  // namespace tracker
}  // namespace walktrack
