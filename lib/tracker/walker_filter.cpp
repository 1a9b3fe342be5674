#include "tracker/walker_filter.h"

#include <algorithm>

#include "body/kinematics.h"
#include "core/log_weights.h"
#include "core/scratch.h"
#include "tracker/frame_likelihood.h"
#include "tracker/moves/global_pose.h"
#include "tracker/smooth/model_error.h"

namespace walktrack {
inline namespace tracker {

namespace {

// Share of the filter's moves that change the global pose; the others change the frame's noise.
// By hand; sensitivity not measured.
constexpr double kGlobalPoseMoves = 0.3;

// Number of walkers in a group: several full vectors, and still enough groups for every thread.
constexpr size_t kGroup = 32;

struct Streams {
  uint64_t seed;
  uint32_t frame;
  size_t start;  // number of the first particle
};

void predict(const MotionContext& motion, const Streams& streams, bool first,
             std::span<WalkerParticle> particles, std::span<Outcome> outcomes) {
  Scratch<8 * 1024> scratch;
  std::pmr::vector<Rng> rngs(scratch.memory());
  rngs.reserve(particles.size());
  for (size_t i = 0; i < particles.size(); ++i)
    rngs.emplace_back(streams.seed, Purpose::kTorque, streams.frame,
                      static_cast<uint32_t>(streams.start + i));
  if (!first) return propagate(motion, particles, rngs, outcomes);
  for (size_t i = 0; i < particles.size(); ++i)
    outcomes[i] = draw_first_noise(motion, particles[i], rngs[i]);
}

HistoryShares history_of(std::span<const WalkerParticle> particles,
                         std::span<const double> weights) {
  HistoryShares out;
  for (size_t i = 0; i < particles.size(); ++i) {
    if (particles[i].continuation == Continuation::kJumped) out.jumped += weights[i];
    if (particles[i].continuation == Continuation::kCaught) out.caught += weights[i];
  }
  return {std::min(1.0, out.jumped), std::min(1.0, out.caught)};
}

void summarise(const WalkerFilterContext& context, const ParticleSet<WalkerParticle>& set,
               FrameRecord& record) {
  const std::vector<double> weights = normalised_weights(set.log_weights);
  for (size_t i = 0; i < weights.size(); ++i)
    if (weights[i] > 0) record.mean_log_likelihood += weights[i] * set.log_likelihoods[i];
  record.tracked = true;
  record.estimate =
      estimate_frame(context.scene.model, set.states, weights, context.scene.dt, context.threads);
  add_model_error(context.scene.cameras, context.model_error, record.estimate);
  record.modes = stride_modes(set.states, weights);
  record.history = history_of(set.states, weights);
  std::vector<uint32_t> chosen(static_cast<size_t>(context.samples));
  systematic_resample(set.log_weights, 0.5, chosen);
  const Body& body = context.scene.model.body;
  record.samples.reserve(chosen.size());
  for (const uint32_t i : chosen)
    record.samples.push_back(forward_kinematics(body, set.states[i].pose).joints);
}

std::vector<KeypointEvidence> keypoints_of(const SceneEvidence& evidence) {
  std::vector<KeypointEvidence> out;
  if (std::none_of(evidence.begin(), evidence.end(), KeypointTerm::says)) return out;
  for (const CameraEvidence& camera : evidence) out.push_back(camera.keypoints);
  return out;
}

}  // namespace

FrameRecord advance(const WalkerFilterContext& context, const SceneEvidence& evidence,
                    uint32_t frame, uint64_t seed, bool first, WalkerFilter& filter) {
  const MotionContext& motion = context.motion;
  std::vector<Outcome> outcomes(filter.particles().states.size());
  filter.predict_groups(
      kGroup, [&](size_t start, std::span<WalkerParticle> particles, std::span<uint8_t> alive) {
        const std::span group = std::span(outcomes).subspan(start, particles.size());
        predict(motion, {seed, frame, start}, first, particles, group);
        for (size_t i = 0; i < group.size(); ++i) alive[i] = group[i] != Outcome::kDead;
      });
  const GlobalPoseSpread course =
      global_pose_spread(filter.particles().states, filter.particles().log_weights);
  const FrameLikelihood likelihood(context.scene, evidence, !first);
  const auto move = [&](WalkerParticle& particle, double step_size, Rng& rng) {
    if (rng.uniform() < kGlobalPoseMoves)
      return move_global_pose(motion, course, step_size, particle, rng);
    perturb(motion, step_size, particle, rng);
  };
  FrameRecord record;
  record.filter = filter.update(frame, likelihood, move);
  record.fallen = static_cast<int>(std::count(outcomes.begin(), outcomes.end(), Outcome::kFallen));
  record.diverged =
      static_cast<int>(std::count(outcomes.begin(), outcomes.end(), Outcome::kDiverged));
  if (!record.filter.all_dead) summarise(context, filter.particles(), record);
  record.keypoints = keypoints_of(evidence);
  return record;
}

}  // namespace tracker
}  // namespace walktrack
