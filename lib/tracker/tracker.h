// The tracker: frames of evidence in, poses with their uncertainty out.
//
//   searching: look for a walk in a sliding window of frames         (tracker/detect/detector.h); a
//   start
//              that explains the window worse than the straight walk it came from has failed. A
//              person of unknown size is sized up by the same window  (tracker/detect/stature.h),
//              once
//   starting:  hypotheses over phase and side compete for a while    (tracker/start_hypotheses.h)
//   tracking:  for every frame: propagate, weigh, resample, estimate (tracker/walker_filter.h)
//   lost:      the monitor says so (tracker/monitor.h); search again, for a while only where the
//              walker can be
//
// Frames before the walk was found, and while it was lost, are reported as not tracked. Searching
// looks a window ahead, so records come out late at first and one for one afterwards.
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "tracker/detect/standing_start.h"
#include "tracker/detect/stature.h"
#include "tracker/monitor.h"
#include "tracker/motion/standing.h"
#include "tracker/smooth/refinement.h"
#include "tracker/start_hypotheses.h"
#include "tracker/walker_filter.h"

namespace walktrack {

struct TrackerConfig {
  MotionConfig motion;
  FilterConfig filter;
  DetectorConfig detector;
  StartConfig start;
  MonitorConfig monitor;
  int samples = 20;        // particles kept of every frame to show the spread
  double model_error = 1;  // multiplies what bands hold beyond the particles' spread
  EstimateKind estimate = EstimateKind::kMap;
};

// All that the next frame of a tracker in its tracking mode depends on.
struct TrackerState {
  uint32_t frame = 0, starts = 0;
  FilterState<WalkerParticle> filter;
  MonitorState monitor;
  int losses = 0;
  double p_legs_swapped = 0;
  std::optional<Stature> stature;
};

// What follows from the body that is tracked.
struct SubjectModel {
  SubjectModel(const BodyModel& model, const GaitPrior& prior, const MotionConfig& config,
               double dt);

  MotionConfig motion;  // to the body's scale
  std::unique_ptr<const MotionModel> moves;
  NoiseScale frame_scale;
  MarkovSteps markov;
  std::optional<StandingProcess> standing;
  PoseTemplates figures;
};

class Tracker {
 public:
  Tracker(TrackerScene scene, const GaitPrior& prior, const TrackerConfig& config, uint64_t seed,
          int threads);

  // Takes the next frame; hands back the records of all frames that are finished now, in order.
  std::vector<FrameRecord> push(const SceneEvidence& evidence);
  // The records of frames that still wait at the end of the video.
  std::vector<FrameRecord> finish();

  // From the next frame on, so many particles: those there are become more or fewer in proportion
  // to their weights.
  void use_particles(int count);

  // Whether the next frame's evidence is to hold its picture: a walk that is looked for in front of
  // one camera has its legs told apart by it.
  bool wants_picture() const {
    return mode_ == Mode::kSearching && !scene_.initial && scene_.cameras.size() == 1;
  }
  // Whether the newest frame has been tracked, so that its particles say where the person is.
  bool tracking() const { return mode_ == Mode::kTracking; }
  const ParticleSet<WalkerParticle>& particles() const { return filter_.particles(); }
  // Their mean in the newest frame, whatever is reported of it; after push() while tracking().
  const Pose& mean_pose() const { return mean_pose_; }
  // Where that is over the ground; after resume(), too.
  Eigen::Vector2d mean_place() const;
  // Times that the track was lost after it had been found.
  int losses() const { return losses_; }
  // Who is tracked: the scene's model until they have been sized up, if it does not know their
  // size.
  const Body& body() const { return scene_.model.body; }
  // What came of that; nullopt while there is no need.
  std::optional<Stature> stature() const { return stature_; }

  // A tracker of the same scene, configuration and seed that takes the state of another one goes on
  // as that one. There is a state only while tracking(): what a search has in hand is large and
  // short-lived.
  TrackerState state() const;
  void resume(TrackerState state);

 private:
  enum class Mode { kSearching, kStarting, kTracking };
  void consume(const SceneEvidence& evidence, std::vector<FrameRecord>& out);
  void search(const SceneEvidence& evidence, std::vector<FrameRecord>& out);
  std::vector<Place> places_in_frame(size_t index, const Body& body,
                                     const PoseTemplates& figures) const;
  const std::vector<Place>& candidates(size_t index);
  bool wants_size() const { return !scene_.size_known && !stature_; }
  WindowScore window_score(const Body& body, const PoseTemplates& figures) const;
  std::vector<DetectedWalk> lines_by_keypoints() const;
  bool walks_clearly(const DetectedWalk& walk);
  std::optional<StandingStart> standing_lead(const DetectedWalk& walk) const;
  bool attempt_standing(const DetectedWalk& walk, std::vector<FrameRecord>& out);
  bool attempt_found(const DetectedWalk& walk, std::vector<FrameRecord>& out);
  void slide(std::vector<FrameRecord>& out);
  std::optional<DetectedWalk> look_for_walk(const BodyModel& model) const;
  Eigen::Vector2d camera_position() const;
  SizedWalk sized_up(const DetectedWalk& walk, double height) const;
  SizedWalk best_size(const DetectedWalk& found) const;
  bool attempt_unsized(const DetectedWalk& found, std::vector<FrameRecord>& out);
  void take_size(const Stature& stature);
  void set_height(double height);
  void start_as_given(std::vector<FrameRecord>& out);
  bool attempt(const DetectedWalk& detected, std::vector<FrameRecord>& out);
  struct Trial;
  void follow_rest(Trial& trial);
  Trial with_mirrored_legs(const Trial& trial);
  Trial with_legs_named(Trial first);
  void begin(const DetectedWalk& detected, std::optional<double> stride_phase);
  void compete(const SceneEvidence& evidence, std::vector<FrameRecord>& out);
  void settle(std::vector<FrameRecord>& out);
  void track(const SceneEvidence& evidence, std::vector<FrameRecord>& out);
  bool labels_may_switch() const;
  FrameRecord follow(const SceneEvidence& evidence);
  void refine(const SceneEvidence& evidence, FrameRecord& record) const;
  WalkerFilterContext context(bool first) const;
  bool within_reach(const Eigen::Vector2d& place, uint32_t frame) const;
  double figure_score(const SceneEvidence& evidence, const FrameEstimate& estimate) const;
  bool is_lost(const SceneEvidence& evidence, const FrameRecord& record);

  TrackerScene scene_;
  const GaitPrior& prior_;
  TrackerConfig config_;
  uint64_t seed_;
  int threads_;
  SubjectModel kit_;

  Mode mode_ = Mode::kSearching;
  uint32_t frame_ = 0;  // of the next evidence to be worked on
  std::vector<Eigen::Vector2d> places_;
  std::deque<SceneEvidence> window_;
  // Frames before the window in which somebody may have stood who walks now; their records have
  // not come out.
  std::deque<SceneEvidence> waiting_;
  size_t slight_walks_ = 0;  // windows in a row that show somebody who may as well stand
  std::deque<std::optional<std::vector<Place>>> candidates_;  // of frames that were asked
  std::optional<StartHypotheses> hypotheses_;
  // Frames of the start hypotheses that are not in the window, to refine what it says of them.
  std::deque<SceneEvidence> hypotheses_frames_;
  uint32_t starts_ = 0;          // how often a search has ended: keys the random streams
  bool start_is_given_ = false;  // the last one
  WalkerFilter filter_;
  Pose mean_pose_;
  MonitorState monitor_;
  int losses_ = 0;
  double p_legs_swapped_ = 0;  // probability that the start has chosen the wrong leg
  std::optional<Stature> stature_;
};

}  // namespace walktrack
