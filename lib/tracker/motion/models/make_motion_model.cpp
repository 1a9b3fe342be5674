#include "tracker/motion/models/make_motion_model.h"

#include "tracker/motion/models/anthropomorphic_motion.h"
#include "tracker/motion/models/kneed_motion.h"
#include "tracker/motion/models/markov_motion.h"

namespace walktrack {
inline namespace tracker {

std::unique_ptr<const MotionModel> make_motion_model(MotionKind kind, const BodyModel& model,
                                                     const GaitPrior& prior) {
  switch (kind) {
    case MotionKind::kKneed:
      break;
    case MotionKind::kAnthropomorphic:
      return std::make_unique<AnthropomorphicMotion>(model);
    case MotionKind::kMarkov:
      return std::make_unique<MarkovMotion>(model);
  }
  return std::make_unique<KneedMotion>(model, prior);
}

}  // namespace tracker
}  // namespace walktrack
