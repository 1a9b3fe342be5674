// The modes of a tracker, each a value that holds everything it needs, and one frame of the modes
// in which the subject is followed:
//
//   Searching --a walk is detected--> Starting --hypotheses are decided--> Tracking
//       ^------- none explains the images ------'                             |
//       ^--------------------- the monitor says: lost -----------------------'
//
// While Tracking, components that turn may compete with the track (tracker/modes/turning.h), and
// several cameras hold frames back, for a new start among them (tracker/start/new_start.h).
// A mode that is tried is a copy; to undo the trial, the copy is dropped (tracker/start/trial.h).
#pragma once

#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "tracker/modes/held_frames.h"
#include "tracker/modes/monitor.h"
#include "tracker/modes/turning.h"
#include "tracker/start/start_hypotheses.h"
#include "tracker/subject_model.h"
#include "tracker/walker_filter.h"

namespace walktrack {
inline namespace tracker {

struct Searching {
  WalkerFilter filter;                // its moves keep the step size that they have learned
  std::optional<LastSeen> last_seen;  // of the track before
};

struct Starting {
  StartHypotheses hypotheses;
  Searching before;  // the mode to which it returns
};

struct Tracking {
  WalkerFilter filter;
  MonitorState monitor;
  double p_legs_swapped = 0;  // probability that the start has chosen the wrong leg
  Pose mean_pose;             // of the newest frame's particles, not of the reported pose
  double speed = 0;           // the same, m/s
  std::optional<TurningTrial> turning{};  // while the frames of the track are not reported
  std::optional<HeldFrames> held{};
};

using TrackMode = std::variant<Searching, Starting, Tracking>;

inline bool is_searching(const TrackMode& mode) { return std::holds_alternative<Searching>(mode); }
inline bool is_tracking(const TrackMode& mode) { return std::holds_alternative<Tracking>(mode); }

// Hypotheses about a walk, one for each range of phases. `number` counts the starts from 1 and keys
// the random streams.
Starting start_around(const TrackContext& context, const DetectedWalk& walk,
                      const std::vector<PhaseRange>& ranges, uint32_t number, Searching before);

// Advances a mode other than Searching by a frame. Returns the records of all frames that are
// finished now, in order; while hypotheses, or components that turn, compete, and while frames are
// held back, there are none.
std::vector<FrameRecord> follow(const TrackContext& context, const SceneEvidence& evidence,
                                uint32_t frame, TrackMode& mode);

// The start hypotheses that are left become one set of particles (Starting becomes Tracking).
// Returns the records of their frames.
std::vector<FrameRecord> settle(TrackMode& mode);

// At the end of a video: components that turn are decided now. Returns the records of their frames.
std::vector<FrameRecord> decide_turning(const TrackContext& context, uint32_t frame, Tracking& now);

// Completes the record of a frame: the most probable pose near the particles' mean, if that is
// wanted (tracker/smooth/refinement.h), and how well it fits the frame's evidence, which no longer
// exists when frames are smoothed. Frames of a start are completed after the start has been
// decided; until then trials use the particles' mean. A record that has been judged is left as it
// is.
void judge(const TrackContext& context, const SceneEvidence& evidence, FrameRecord& record);

// The mean of the particles over the ground, m.
Eigen::Vector2d mean_place(const Tracking& now);

// The particles become more or fewer, in proportion to their weights.
void use_particles(int count, Tracking& now);

}  // namespace tracker
}  // namespace walktrack
