// The modes of a tracker, each a value that holds all that it needs, and one frame of those in
// which somebody is followed:
//
//   Searching --a walk is detected--> Starting --hypotheses are decided--> Tracking
//       ^------- none explains the images ------'                             |
//       ^--------------------- the monitor says: lost -----------------------'
//
// A mode that is tried is a copy; to take the trial back is to drop it (tracker/start/trial.h).
#pragma once

#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "tracker/modes/monitor.h"
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
  bool given;        // by the scene
  Searching before;  // what it goes back to
};

struct Tracking {
  WalkerFilter filter;
  MonitorState monitor;
  double p_legs_swapped = 0;  // probability that the start has chosen the wrong leg
  Pose mean_pose;             // of the newest frame's particles, whatever is reported of it
};

using TrackMode = std::variant<Searching, Starting, Tracking>;

inline bool is_searching(const TrackMode& mode) { return std::holds_alternative<Searching>(mode); }
inline bool is_tracking(const TrackMode& mode) { return std::holds_alternative<Tracking>(mode); }

// Hypotheses about a walk; all over the stride, or at a stated phase of it. `number` of the start,
// from 1: it keys the random streams.
Starting start_around(const TrackContext& context, const DetectedWalk& walk,
                      std::optional<double> stride_phase, uint32_t number, Searching before);

// Takes a mode other than Searching through a frame. Hands back the records of all frames that are
// finished now, in order; while hypotheses compete there are none.
std::vector<FrameRecord> follow(const TrackContext& context, const SceneEvidence& evidence,
                                uint32_t frame, TrackMode& mode);

// What is left of the start hypotheses, Starting, becomes one set of particles. Hands back the
// records of their frames.
std::vector<FrameRecord> settle(TrackMode& mode);

// What is reported of a finished frame: the most probable pose near the particles' mean, if that is
// wanted (tracker/smooth/refinement.h), and how well it fits the frame's evidence, which is gone
// when frames are smoothed. For a frame of a start: once it has been decided who walks there, and
// which leg is which; until then the particles' word is tried.
void judge(const TrackContext& context, const SceneEvidence& evidence, FrameRecord& record);

// The mean of the particles over the ground, m.
Eigen::Vector2d mean_place(const Tracking& now);

// The particles become more or fewer, in proportion to their weights.
void use_particles(int count, Tracking& now);

}  // namespace tracker
}  // namespace walktrack
