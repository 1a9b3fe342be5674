#include "tracker/modes/filter_frame.h"

#include <algorithm>
#include <optional>

#include "core/log_weights.h"
#include "tracker/frame_likelihood.h"
#include "tracker/moves/mirror_legs.h"

namespace walktrack {
inline namespace tracker {

namespace {

const WalkerParticle& best_particle(const ParticleSet<WalkerParticle>& set) {
  const auto best = std::max_element(set.log_weights.begin(), set.log_weights.end());
  return set.states[static_cast<size_t>(best - set.log_weights.begin())];
}

// The place in the stride that is expected in the next frame; nullopt if the legs cannot switch:
// only the kneed walker makes phase jumps (tracker/moves/phase_jump.h).
std::optional<double> expected_phase(const TrackContext& context, const WalkerFilter& filter) {
  if (context.config.motion.model != MotionKind::kKneed) return std::nullopt;
  const auto& set = filter.particles();
  const std::vector<double> weights = normalised_weights(set.log_weights);
  if (stride_modes(set.states, weights).standing >= 0.5) return std::nullopt;
  return phase_ahead(set.states, weights, context.scene.dt);
}

}  // namespace

FilteredFrame filter_frame(const TrackContext& context, const WalkerFilterContext& filter_context,
                           const SceneEvidence& evidence, uint32_t frame, uint64_t seed,
                           WalkerFilter& filter) {
  const std::optional<double> expected = expected_phase(context, filter);
  FilteredFrame out{advance(filter_context, evidence, frame, seed, false, filter)};
  FrameRecord& record = out.record;
  if (!record.tracked) return out;
  if (expected && record.modes.standing < 0.5) {
    if (context.scene.cameras.size() > 1) {
      out.legs_switched = apart(*expected, record.modes.phase);
    } else if (label_switched(*expected, record.modes.phase)) {
      mirror_legs(filter_context.motion, filter);
      mirror_legs(context.body(), record);
    }
  }
  record.evidence =
      FrameLikelihood(context.scene, evidence, true).by_term(best_particle(filter.particles()));
  return out;
}

}  // namespace tracker
}  // namespace walktrack
