#include "tracker/modes/monitor.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/median.h"
#include "tracker/tracker_scene.h"

namespace walktrack {
inline namespace tracker {

namespace {

// Walkers whose score is not above this share of the score of a rigid figure are lost. For a person
// who is a few dozen pixels high, a rigid figure is nearly as good as the walker itself. By hand;
// sensitivity not measured.
constexpr double kFigureShare = 0.9;

// The speed in a single frame is noisy. By hand.
constexpr double kVelocityMemory = 1;  // s

// By hand: half a step, and the change of velocity of a subject who stops or turns aside.
constexpr double kNear = 0.5, kTurnsAside = 0.8;  // m, m/s

}  // namespace

void begin_watch(std::deque<double> log_likelihoods, MonitorState& state) {
  state.log_likelihoods = std::move(log_likelihoods);
  state.frames_below = state.frames_outscored = state.frames_off = 0;
}

bool is_fading(const MonitorConfig& config, double least_score, double dt, double log_likelihood,
               double figure, MonitorState& state) {
  auto& past = state.log_likelihoods;
  const double least =
      std::max(config.lost_below * median_of({past.begin(), past.end()}), least_score);
  const bool outscored = figure > least && log_likelihood < kFigureShare * figure;
  const bool below = log_likelihood < least;
  state.frames_outscored = outscored ? state.frames_outscored + 1 : 0;
  state.frames_below = below || outscored ? state.frames_below + 1 : 0;
  // Frames that are explained badly do not enter the median.
  if (state.frames_below == 0) past.push_back(log_likelihood);
  while (static_cast<int>(past.size()) > frames_in(config.evidence_window, dt)) past.pop_front();
  return state.frames_below >= frames_in(config.lost_after, dt) ||
         state.frames_outscored >= frames_in(config.outscored_after, dt);
}

bool is_off_people(const MonitorConfig& config, double dt, std::optional<bool> on_somebody,
                   MonitorState& state) {
  const bool on = on_somebody.value_or(false), off = on_somebody.has_value() && !on;
  state.frames_off = on || !(off || state.frames_off > 0) ? 0 : state.frames_off + 1;
  return state.frames_off >= frames_in(config.off_detected_after, dt);
}

void see(const FrameEstimate& estimate, uint32_t frame, double dt, MonitorState& state) {
  const Pose& pose = estimate.pose;
  const Eigen::Vector2d now =
      estimate.speed * Eigen::Vector2d(std::cos(pose.heading), std::sin(pose.heading));
  const Eigen::Vector2d before = state.last_seen ? state.last_seen->velocity : now;
  const double kept = std::exp(-dt / kVelocityMemory);
  state.last_seen = {pose.root.head<2>(), kept * before + (1 - kept) * now, frame};
}

std::optional<Reach> reach_of(const MonitorConfig& config, const std::optional<LastSeen>& last_seen,
                              uint32_t frame, double dt, const InPicture& in_picture) {
  if (!last_seen) return std::nullopt;
  const double elapsed = dt * (frame - last_seen->frame);
  if (elapsed > config.reacquire_within) return std::nullopt;
  const Eigen::Vector2d walked = elapsed * last_seen->velocity;
  const double aside = kNear + kTurnsAside * elapsed;
  const Eigen::Vector2d expected = last_seen->position + walked;
  if (in_picture(expected)) return Reach{expected, aside};
  return Reach{last_seen->position, aside + walked.norm()};
}

}  // namespace tracker
}  // namespace walktrack
