#include "tracker/start/stride_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/parallel_for.h"
#include "tracker/motion/models/kneed_motion.h"

namespace walktrack {
inline namespace tracker {

namespace {

constexpr int kPosesOfStep = 12;               // by hand: the feet move by 10 cm between two
constexpr std::array kPeriods{0.9, 1.0, 1.1};  // shares of the usual step's, by hand

using ScoresOfPoses = std::vector<double>;  // nats, by pose of the stride

double heading_of(const DetectedWalk& walk) {
  return std::atan2(walk.velocity.y(), walk.velocity.x());
}

// Poses from the strike of the left foot on, at equal distances in phase.
std::vector<Pose> poses_of_stride(const BodyModel& model, const PriorGait& gait) {
  std::vector<Pose> out;
  for (const Side stance : {Side::kLeft, Side::kRight})
    for (int k = 0; k < kPosesOfStep; ++k)
      out.push_back(pose_in_gait(model, gait, stance, (k + 0.5) / kPosesOfStep));
  return out;
}

std::vector<ScoresOfPoses> scores_by_frame(const TrackContext& context,
                                           const std::deque<SceneEvidence>& window,
                                           const DetectedWalk& walk,
                                           const std::vector<Pose>& poses) {
  std::vector<ScoresOfPoses> out(window.size());
  parallel_for(window.size(), context.threads, [&](size_t t) {
    const Eigen::Vector2d place =
        walk.position + static_cast<double>(t) * context.scene.dt * walk.velocity;
    for (const Pose& pose : poses)
      out[t].push_back(place_score(context.scene, window[t], context.body(), {&pose, 1}, place,
                                   heading_of(walk)));
  });
  return out;
}

// Of the stride, in [0, 1).
double middle(const PhaseRange& range) {
  return 0.5 * (static_cast<double>(range.stance == Side::kRight) + 0.5 * (range.from + range.to));
}

// Of a walk that begins at that phase and advances by so many strides a frame.
double score_in_step(const std::vector<ScoresOfPoses>& scores, double phase, double advance) {
  double sum = 0;
  for (const ScoresOfPoses& of_frame : scores) {
    const auto poses = static_cast<double>(of_frame.size());
    sum += of_frame[std::min(of_frame.size() - 1, static_cast<size_t>(phase * poses))];
    phase += advance;
    phase -= std::floor(phase);
  }
  return sum;
}

}  // namespace

std::vector<double> stride_scores(const TrackContext& context,
                                  const std::deque<SceneEvidence>& window, const DetectedWalk& walk,
                                  const std::vector<PhaseRange>& ranges) {
  const BodyModel& model = context.scene.model;
  const PriorGait gait = usual_gait(model, context.prior, walk.velocity.norm(), heading_of(walk));
  const std::vector<ScoresOfPoses> scores =
      scores_by_frame(context, window, walk, poses_of_stride(model, gait));
  std::vector<double> out;
  for (const PhaseRange& range : ranges) {
    double best = -std::numeric_limits<double>::infinity();
    for (const double share : kPeriods)
      best = std::max(
          best, score_in_step(scores, middle(range), context.scene.dt / (2 * share * gait.period)));
    out.push_back(best);
  }
  return out;
}

std::vector<PhaseRange> likely_ranges(const TrackContext& context,
                                      const std::deque<SceneEvidence>& window,
                                      const DetectedWalk& walk) {
  const StartConfig& start = context.config.start;
  if (walk.given && context.scene.initial_phase)
    return phase_ranges(start, *context.scene.initial_phase);
  std::vector<PhaseRange> ranges = phase_ranges(start);
  if (walk.given || walk.standing || walk.hidden_frames > 0) return ranges;
  const std::vector<double> scores = stride_scores(context, window, walk, ranges);
  const auto best = std::max_element(scores.begin(), scores.end()) - scores.begin();
  const auto half = static_cast<long>(ranges.size() / 2);
  std::vector<PhaseRange> out;
  for (long k = 0; k < 2 * half; ++k) {
    const long apart = (k - best + 2 * half) % half;
    if (std::min(apart, half - apart) <= 1) out.push_back(ranges[static_cast<size_t>(k)]);
  }
  return out;
}

}  // namespace tracker
}  // namespace walktrack
