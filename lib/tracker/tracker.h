// The tracker turns the evidence of frames into poses with their uncertainty. Its modes:
//
//   searching  for a walk in a sliding window of frames (tracker/detect/walk_search.h), or near the
//              place that the scene states, in the window that begins then; it is tried out on
//              the window (tracker/start/window_start.h). The height of a
//              subject, if it is unknown, is estimated from the same window, once
//              (tracker/detect/stature.h).
//   starting   hypotheses over phase and side compete for a while
//              (tracker/start/start_hypotheses.h)
//   tracking   for every frame: propagate, weigh, resample, estimate (tracker/walker_filter.h);
//              before one camera, components that turn compete with it (tracker/modes/turning.h);
//              before several, frames are held back for a new start, or for another moment of
//              setting off (tracker/start/new_start.h)
//   lost when the monitor decides so (tracker/modes/monitor.h); searching again, for a while only
//   where the subject can be
//
// Modes are values (tracker/modes/track_mode.h). Frames before the walk was found, and while it was
// lost, are reported as not tracked. Searching needs a whole window, so that records come out late
// at first and one for each frame afterwards; before one camera they are up to 1.25 s late, before
// several up to 2.5 s, and 5 s if at the end of these the subject sets off, or the legs switch.
#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "tracker/detect/walk_search.h"
#include "tracker/modes/track_mode.h"
#include "tracker/others/nearby_people.h"
#include "tracker/start/window_start.h"
#include "tracker/tracked_subject.h"

namespace walktrack {
inline namespace tracker {

// Everything on which the next frame of a tracker in its tracking mode depends.
struct TrackerState {
  uint32_t frame = 0, starts = 0;
  FilterState<WalkerParticle> filter;
  MonitorState monitor;
  int losses = 0;
  double p_legs_swapped = 0;
  double speed = 0;  // m/s
  SubjectEstimates estimates;
  bool keypoints_lead = false;
  NearbyPeople people;
  int frames_beside_others = 0;
};

class Tracker {
 public:
  Tracker(TrackerScene scene, const GaitPrior& prior, const TrackerConfig& config, uint64_t seed,
          int threads);

  // Takes the next frame and returns the records of all frames that are finished now, in order.
  std::vector<FrameRecord> push(const SceneEvidence& evidence);
  // The records of frames that still wait at the end of the video.
  std::vector<FrameRecord> finish();

  // Sets the number of particles from the next frame on: the present particles become more or fewer
  // in proportion to their weights.
  void use_particles(int count) {
    subject_.config.filter.particles = count;
    if (tracking()) walktrack::use_particles(count, std::get<Tracking>(mode_));
  }

  // Whether the next frame's evidence has to hold its image: for one camera, the labels of the legs
  // of a walk that is searched come from the images.
  bool wants_picture() const {
    return is_searching(mode_) && !before_given() && subject_.scene.cameras.size() == 1;
  }
  // Whether the newest frame has been tracked, so that its particles say where the person is.
  bool tracking() const { return is_tracking(mode_); }
  // While tracking():
  const ParticleSet<WalkerParticle>& particles() const { return tracked().filter.particles(); }
  // The mean of the particles in the newest frame, which is not the reported pose; after push().
  const Pose& mean_pose() const { return tracked().mean_pose; }
  // The same, m/s; also after resume().
  double speed() const { return tracked().speed; }
  // The place of that mean over the ground; also after resume().
  Eigen::Vector2d mean_place() const { return walktrack::mean_place(tracked()); }

  // Whether somebody else may be near the subject, so that more of the picture is of interest.
  bool somebody_is_near() const { return tracking() && walktrack::somebody_is_near(people_); }

  // Tracked frames in which pixels of others were left out, except in the window of a search.
  int frames_beside_others() const { return frames_beside_others_; }

  // Times that the track was lost after it had been found.
  int losses() const { return losses_; }
  // The body that is tracked: the scene's model, until the height has been estimated if the scene
  // does not state it.
  const Body& body() const { return model().body; }
  const BodyModel& model() const { return subject_.scene.model; }
  // Whether keypoints count for more than outlines (tracker/start/keypoint_lead.h).
  bool keypoints_lead() const { return subject_.keypoints_lead(); }
  SubjectEstimates estimates() const { return subject_.estimates(); }

  // A tracker of the same scene, configuration and seed that resumes the state of another one
  // continues like that one. There is a state only while has_state(): the data of a search, and of
  // frames that are not reported yet, are large and short-lived. Before several cameras a subject
  // who stands has one every ten seconds.
  bool has_state() const { return tracking() && !tracked().turning && !tracked().held; }
  TrackerState state() const;
  void resume(TrackerState state);

 private:
  using Records = std::vector<FrameRecord>;
  void consume(const SceneEvidence& evidence, Records& out);
  void search(const SceneEvidence& evidence, Records& out);
  // Of the windows that a walk is searched in, every `step`-th is looked at.
  void look_for_walk(size_t step, Records& out);
  void begin(WindowStart start, Records& out);
  // Tries the walk that the scene states, once; whether it starts a track.
  bool start_given(Records& out);
  void report(Records records, const SceneEvidence& newest, Records& out);
  std::optional<SceneEvidence> without_others(const SceneEvidence& evidence);

  const Tracking& tracked() const { return std::get<Tracking>(mode_); }
  // Whether the scene states a walk that has not been used yet.
  bool given() const { return subject_.scene.initial.has_value(); }
  // Whether the next frame comes before it.
  bool before_given() const {
    return given() && frame_ < static_cast<uint32_t>(subject_.scene.initial_frame);
  }

  TrackedSubject subject_;
  TrackMode mode_;
  NearbyPeople people_;  // while the subject is followed
  WalkSearch search_;
  std::deque<SceneEvidence> waiting_;  // frames that are tracked and not reported yet
  uint32_t frame_ = 0;                 // the next to be tracked
  uint32_t starts_ = 0;                // tried
  int losses_ = 0;
  int frames_beside_others_ = 0;
};

}  // namespace tracker
}  // namespace walktrack
