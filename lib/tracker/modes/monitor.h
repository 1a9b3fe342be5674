// Decides whether the track is still on the subject. It compares the filter's short-term evidence
// with its own long-term evidence and with that of a rigid figure (tracker/modes/loss.h; monitoring
// for failures, as Thrun, Burgard & Fox 2005, section 8.3.3, do for localisation), and looks
// whether the figure lies on a person whose keypoints are detected. It also keeps where the subject
// was last seen for certain, and their velocity, which say where to search for them.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <vector>

#include "tracker/figure_fit.h"
#include "tracker/smooth/estimate.h"

namespace walktrack {
inline namespace tracker {

// By hand; sensitivity not measured.
struct MonitorConfig {
  // Share of the log-likelihood's median below which the track counts as lost
  double lost_below = 0.35;
  double lost_after = 1;  // s below it: the time for which a subject may be hidden
  // s of explaining the images worse than a rigid figure
  double outscored_after = 0.4;
  double off_detected_after = 0.5;  // s of lying on none of the people who are detected
  double evidence_window = 1.5;     // s of past likelihoods over which the median is taken
  double reacquire_within = 4;      // s for which a lost subject is searched only within reach
};

// Where the subject was last seen for certain, and their velocity.
struct LastSeen {
  Eigen::Vector2d position = Eigen::Vector2d::Zero(), velocity = position;  // m, m/s
  uint32_t frame = 0;
};

struct MonitorState {
  std::optional<LastSeen> last_seen;
  std::deque<double> log_likelihoods;  // likelihoods of frames that were explained, the newest last
  // Numbers of successive frames that were explained badly, that were explained worse than by a
  // rigid figure, and in which the figure lay on no detected person.
  int frames_below = 0, frames_outscored = 0, frames_off = 0;
  // With several cameras: of the newest frames that are decided (tracker/start/new_start.h).
  std::vector<FigureFit> fits;
};

// Begins a track; the likelihoods are those of its first frames.
void begin_watch(std::deque<double> log_likelihoods, MonitorState& state);

// Updates with the scores of a frame, of the particles and of a rigid figure, and
// returns whether the track is lost. A score below `least_score` does not count as explained. `dt`:
// s between frames.
bool is_fading(const MonitorConfig& config, double least_score, double dt, double log_likelihood,
               double figure, MonitorState& state);

// Updates with whether the figure lies on a detected person (nullopt if nobody is detected), and
// returns whether the track is lost.
bool is_off_people(const MonitorConfig& config, double dt, std::optional<bool> on_somebody,
                   MonitorState& state);

// Stores where the subject is, and their velocity.
void see(const FrameEstimate& estimate, uint32_t frame, double dt, MonitorState& state);

// Where a subject who was lost can be: in a circle on the ground, m.
struct Reach {
  Eigen::Vector2d middle;
  double radius;

  bool contains(const Eigen::Vector2d& place) const { return (place - middle).norm() < radius; }
};

// Whether a place is in any picture.
using InPicture = std::function<bool(const Eigen::Vector2d& place)>;

// Where they can be in a frame: near the place to which they were going, or, if that place is in no
// picture, as far from where they were last seen as they walk, because they may have turned around
// unseen. nullopt: anywhere.
std::optional<Reach> reach_of(const MonitorConfig& config, const std::optional<LastSeen>& last_seen,
                              uint32_t frame, double dt, const InPicture& in_picture);

}  // namespace tracker
}  // namespace walktrack
