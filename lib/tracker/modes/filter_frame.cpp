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

// Whether left and right can be swapped unnoticed: several cameras would show it, and only the
// kneed walker makes phase jumps (tracker/moves/phase_jump.h).
bool labels_may_switch(const TrackContext& context) {
  return context.scene.cameras.size() == 1 && context.config.motion.model == MotionKind::kKneed;
}

}  // namespace

FrameRecord filter_frame(const TrackContext& context, const WalkerFilterContext& filter_context,
                         const SceneEvidence& evidence, uint32_t frame, uint64_t seed,
                         WalkerFilter& filter) {
  std::optional<double> expected;  // place in the stride
  if (labels_may_switch(context)) {
    const auto& set = filter.particles();
    expected = phase_ahead(set.states, normalised_weights(set.log_weights), context.scene.dt);
  }
  FrameRecord record = advance(filter_context, evidence, frame, seed, false, filter);
  if (!record.tracked) return record;
  if (expected && record.modes.standing < 0.5 && label_switched(*expected, record.modes.phase)) {
    mirror_legs(filter_context.motion, filter);
    mirror_legs(context.body(), record);
  }
  record.evidence =
      FrameLikelihood(context.scene, evidence, true).by_term(best_particle(filter.particles()));
  return record;
}

}  // namespace tracker
}  // namespace walktrack
