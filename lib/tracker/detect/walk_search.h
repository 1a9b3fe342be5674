// Looking for a walk in a window of frames that slides over the video (tracker/detect/detector.h),
// and for somebody who stood before it (tracker/detect/standing_start.h).
#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "tracker/detect/search_window.h"
#include "tracker/detect/standing_start.h"

namespace walktrack {
inline namespace tracker {

// When and where the window is: number of its first frame, and where a subject who was lost was
// last seen.
struct SearchMoment {
  uint32_t first_frame;
  const std::optional<LastSeen>& last_seen;
};

class WalkSearch {
 public:
  // Takes the next frame into the window.
  void push(const SceneEvidence& evidence);
  const std::deque<SceneEvidence>& window() const { return window_; }
  // Frames before the window in which somebody may have stood who walks now; their records have not
  // come out.
  size_t waiting() const { return waiting_.size(); }

  // The walk through the window; nullopt when nobody walks there, or not clearly.
  std::optional<DetectedWalk> find(const TrackContext& context, const SearchMoment& moment);
  // That walk with the subject's height.
  SizedWalk with_size(const TrackContext& context, const SearchMoment& moment,
                      const DetectedWalk& walk) const;
  // The same of a walk whose line is certain.
  SizedWalk with_size_along(const TrackContext& context, const SearchMoment& moment,
                            const DetectedWalk& walk) const;
  // The subject has become of another size.
  void forget_places() { places_.clear(); }

  // Somebody who stands before the walk, if anybody does; the score is that of both.
  std::optional<StandingStart> standing_lead(const TrackContext& context,
                                             const DetectedWalk& walk) const;
  // The window begins so many frames earlier, of those that wait; or later again.
  void reach_back(size_t frames);
  void let_go(size_t frames);

  // The window begins a frame later; whether one that waited is given up.
  bool slide(const TrackContext& context);
  // Hands over the window's frames; nothing waits any more.
  std::deque<SceneEvidence> take();

 private:
  SearchWindow view(const TrackContext& context, const SearchMoment& moment) const;
  const std::vector<Place>& candidates(const SearchWindow& window, size_t index);
  bool walks_clearly(const TrackContext& context, const DetectedWalk& walk);

  std::deque<SceneEvidence> waiting_, window_;
  std::deque<std::optional<std::vector<Place>>> candidates_;  // of the window's frames, once asked
  std::vector<Eigen::Vector2d> places_;                       // of a figure, once asked
  size_t slight_walks_ = 0;  // windows in a row that show somebody who may as well stand
};

}  // namespace tracker
}  // namespace walktrack
