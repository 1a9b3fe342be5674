#include "tracker/modes/turning.h"

#include <algorithm>
#include <array>
#include <utility>

namespace walktrack {
inline namespace tracker {

namespace {

// By hand, on turns before one camera (tracker/reports/feet_and_heading.md): the time for which
// components compete with the track, and the nats by which one has to be better. On straight walks
// the best component is -350 to 50 nats better, and in 2 of 30 trials 130 and 220; in turns 100 to
// 1000.
constexpr double kTrial = 1.25;   // s
constexpr double kClearly = 100;  // nats
// Multiples of MotionConfig::turning_yaw_rate_sd: how fast somebody turns is not known.
constexpr std::array kRates{1.0, 1.5};

WalkerFilterContext turning_context(const TrackContext& context, double yaw_rate_sd) {
  WalkerFilterContext out = filter_context(context);
  MotionContext& motion = out.motion;
  motion.config.yaw_rate_sd = yaw_rate_sd;
  motion.scale.residual[kHeading] = frame_noise(
      motion.config, kHeading, motion.moves.constants(motion.config, kHeading), motion.dt);
  return out;
}

}  // namespace

int turning_components(const MotionConfig& motion, Path path, size_t cameras) {
  const bool turns = motion.turning_yaw_rate_sd > 0 && path == Path::kSpatial && cameras == 1;
  return turns ? int{kRates.size()} : 0;
}

FilterConfig component_config(FilterConfig filter) {
  filter.moves = (filter.moves + 1) / 2;  // enough for a comparison
  return filter;
}

TurningTrial components_that_turn(const TrackContext& context, const WalkerFilter& track,
                                  uint32_t frame) {
  TurningTrial out;
  for (const double rate : kRates) {
    // Separate streams of random numbers.
    const uint64_t number = kRates.size() * frame + out.components.size() + 1;
    const uint64_t seed = context.seed + 0xA24BAED4963EE407u * number;
    WalkerFilter filter(component_config(context.config.filter), seed, context.threads);
    filter.resume(track.state());
    out.components.push_back(
        {std::move(filter), rate * context.subject.motion.turning_yaw_rate_sd, seed});
  }
  return out;
}

bool step(const TrackContext& context, const SceneEvidence& evidence, uint32_t frame,
          FrameRecord record, TurningTrial& trial) {
  for (TurningComponent& each : trial.components) {
    const WalkerFilterContext turning = turning_context(context, each.yaw_rate_sd);
    each.records.push_back(
        filter_frame(context, turning, evidence, frame, each.seed, each.filter).record);
    each.lead += each.records.back().filter.log_evidence - record.filter.log_evidence;
  }
  std::erase_if(trial.components,
                [](const TurningComponent& each) { return !each.records.back().tracked; });
  trial.records.push_back(std::move(record));
  return static_cast<int>(trial.records.size()) >= frames_in(kTrial, context.scene.dt);
}

TurningComponent* winner(TurningTrial& trial) {
  const auto best = std::max_element(
      trial.components.begin(), trial.components.end(),
      [](const TurningComponent& a, const TurningComponent& b) { return a.lead < b.lead; });
  return best == trial.components.end() || best->lead < kClearly ? nullptr : &*best;
}

}  // namespace tracker
}  // namespace walktrack
