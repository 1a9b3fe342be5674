// Whether what is tracked is still the subject, judged by what a filter cannot judge by itself: its
// short-term evidence against its own long-term one, and against that of a figure that merely
// stands in the same place (a failure monitor beside the estimator, as Thrun, Burgard & Fox 2005,
// section 8.3.3, do for localisation); and whether the figure lies on anybody whose keypoints are
// seen. Where the subject was last surely seen, and how they went on, says where to look for them.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "tracker/smooth/estimate.h"

namespace walktrack {
inline namespace tracker {

// By hand; sensitivity not measured.
struct MonitorConfig {
  double lost_below = 0.35;  // share of the likelihood's own median at which the track is lost
  double lost_after = 1;     // s below it: so long may a walker be hidden
  double outscored_after =
      0.4;  // s of explaining the images worse than a stiff figure in its place
  double off_detected_after = 0.5;  // s of lying on none of the people whose keypoints are seen
  double evidence_window = 1.5;     // s of past likelihoods that the median is taken over
  double reacquire_within = 4;  // s for which a lost walker is looked for only where they can be
};

// Where the walker was last surely seen, and how they went on.
struct LastSeen {
  Eigen::Vector2d position = Eigen::Vector2d::Zero(), velocity = position;  // m, m/s
  uint32_t frame = 0;
};

struct MonitorState {
  std::optional<LastSeen> last_seen;
  std::deque<double> log_likelihoods;  // of frames that were explained, the newest last
  // In a row: explained badly, worse than by a stiff figure, and since the figure lay on somebody
  // whose keypoints were seen.
  int frames_below = 0, frames_outscored = 0, frames_off = 0;
};

// A track begins whose first frames were explained that well.
void begin_watch(std::deque<double> log_likelihoods, MonitorState& state);

// Takes in how well a frame was explained, by the particles and by a stiff figure in their place;
// whether the track is lost. `least_score`: below it nothing counts as explained. `dt`: s a frame.
bool is_fading(const MonitorConfig& config, double least_score, double dt, double log_likelihood,
               double figure, MonitorState& state);

// Takes in whether the figure lies on somebody whose keypoints are seen, nullopt if nobody's are;
// whether the track is lost.
bool is_off_people(const MonitorConfig& config, double dt, std::optional<bool> on_somebody,
                   MonitorState& state);

// Remembers where the walker is and how they have been going on.
void see(const FrameEstimate& estimate, uint32_t frame, double dt, MonitorState& state);

// Whether a walker who was lost can be at a place: not far from where they were going.
bool is_within_reach(const MonitorConfig& config, const std::optional<LastSeen>& last_seen,
                     const Eigen::Vector2d& place, uint32_t frame, double dt);

}  // namespace tracker
}  // namespace walktrack
