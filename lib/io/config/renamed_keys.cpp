#include "io/config/renamed_keys.h"

#include <array>

namespace walktrack {
inline namespace io {

std::span<const RenamedKey> renamed_keys() {
  static constexpr std::array kRenamed{
      RenamedKey{"motion.unrest", "motion.markov_noise_scale"},
      RenamedKey{"motion.clock", "motion.phase_noise"},
      RenamedKey{"motion.turning", "motion.yaw_rate_sd"},
      RenamedKey{"motion.facing", "motion.heading_time_constant"},
      RenamedKey{"motion.misfit", "motion.residual_scale"},
      RenamedKey{"motion.landing", "motion.footfall_sd"},
      RenamedKey{"motion.settling", "motion.footfall_decay"},
      RenamedKey{"motion.arrival", "motion.start_position_sd"},
      RenamedKey{"motion.given", "motion.given_position_sd"},
      RenamedKey{"motion.rephasing", "motion.phase_jump_rate"},
      RenamedKey{"search.window", "detector.window"},
      RenamedKey{"search.slowest", "detector.slowest"},
      RenamedKey{"search.fastest", "detector.fastest"},
      RenamedKey{"search.complete", "detector.least_share"},
      RenamedKey{"search.least_score", "detector.least_score"},
      RenamedKey{"search.candidates", "detector.candidates"},
      RenamedKey{"search.grid_px", "detector.grid_px"},
      RenamedKey{"track.beaten_after", "track.outscored_after"},
      RenamedKey{"track.seek", "track.reacquire_within"},
      RenamedKey{"track.recall", "track.evidence_window"},
      RenamedKey{"gates.legs_exchanged", "quality.legs_swapped"},
      RenamedKey{"gates.lost_share", "quality.lost_share"},
      RenamedKey{"gates.untracked_movement", "quality.untracked_movement"},
      RenamedKey{"gates.least_steps", "quality.least_steps"},
      RenamedKey{"gates.overlap", "quality.overlap"},
      RenamedKey{"gates.leg_swaps", "quality.leg_swaps"},
      RenamedKey{"gates.steps_off_way", "quality.steps_off_way"},
      RenamedKey{"gates.longest_step", "quality.longest_step"},
      RenamedKey{"gates.shortest_step", "quality.shortest_step"},
      RenamedKey{"gates.fastest", "quality.fastest"},
      RenamedKey{"gates.foot_slide", "quality.foot_slide"},
      RenamedKey{"gates.penetration", "quality.penetration"},
      RenamedKey{"gates.jitter", "quality.jitter"},
  };
  return kRenamed;
}

}  // namespace io
}  // namespace walktrack
