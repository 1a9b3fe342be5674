// The compass gait of Goswami, Thuilot & Espiau, "Compass-like biped robot", INRIA 1996.
#pragma once

#include "core/conventions.h"
#include "walker/linkage/models.h"

namespace walktrack {

inline StraightLeggedParameters goswami() {
  return {.gravity = 9.81,
          .slope = rad_from_deg(3),
          .hip_mass = 10,
          .leg_mass = 5,
          .leg_inertia = 0,
          .hip_to_arc = 1,
          .com_below_hip = .5,
          .foot_radius = 0};
}

}  // namespace walktrack
