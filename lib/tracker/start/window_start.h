// The start of a track in the window of a search: a walk is detected in it, or is near the one that
// the scene states, the height is estimated if it is unknown, and the window's frames are tracked
// as a trial (tracker/start/trial.h).
//
// If the trial shows that the figure is too thin for the subject, the trial is dropped and the walk
// detected anew: with a wider figure if the outlines tell its girth (tracker/figure/girth.h), and
// with keypoints that lead from then on otherwise (tracker/start/keypoint_lead.h). What the usual
// figure has found is kept meanwhile, for a subject who is not clearly wide. Of a subject who
// was half hidden at first two walks are tried, and the one that explains the frames better is
// taken. A subject who stood before the walk is tracked from there on
// (tracker/detect/standing_start.h), unless that trial fails.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "tracker/detect/walk_search.h"
#include "tracker/modes/track_mode.h"
#include "tracker/tracked_subject.h"

namespace walktrack {
inline namespace tracker {

struct WindowStart {
  std::deque<SceneEvidence> frames;  // of the window and of standing before it
  uint32_t first_frame;              // number of the first of them
  std::vector<FrameRecord> records;  // of those that are finished
  bool legs_in_doubt;                // before several cameras
  size_t untracked;                  // number of frames before them in which nobody was tracked
  NearbyPeople people;               // after the window
};

// A walk that the scene states (TrackerScene::initial) begins in the window's first frame.
// `first_frame` is the number of the window's first frame, `starts` the number of trials so far.
// If a trial succeeds, `mode` is the mode after the window's frames; otherwise nullopt is returned
// and `mode` keeps searching.
std::optional<WindowStart> start_in_window(TrackedSubject& subject, WalkSearch& search,
                                           uint32_t first_frame, uint32_t& starts, TrackMode& mode);

}  // namespace tracker
}  // namespace walktrack
