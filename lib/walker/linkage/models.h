// The models with feet, as tables for LinkageWalker. Published tables have the opposite sign of
// angles: change the sign of every angle and rate; the slope keeps its sign (core/conventions.h).
#pragma once

#include "walker/kneed/kneed_walker.h"
#include "walker/linkage/linkage.h"

namespace walktrack {
inline namespace walker {

// A hub on spokes that rolls down a slope (McGeer 1990; Tedrake, "Underactuated Robotics", ch. 4).
// q = (stance spoke).
struct RimlessWheelParameters {
  double gravity = 1;                       // m/s^2
  double slope = 0.08;                      // rad, > 0 downhill
  double mass = 1;                          // kg
  double spoke = 1;                         // m
  double half_angle = 0.39269908169872414;  // rad, half the angle between spokes (pi / 8)
  double gyration = 0;                      // m, radius of gyration about the hub
};
Linkage rimless_wheel(const RimlessWheelParameters& parameters);

// Two straight legs with rolling feet, a point mass at the hip: the anthropomorphic walker (McGeer
// 1990; Kuo 2002) with its hip spring and toe-off impulse, and without them the passive walkers of
// McGeer, Goswami and, in the limit of light legs, Garcia. q = (stance leg, swing leg).
struct StraightLeggedParameters {
  double gravity = 1;               // m/s^2
  double slope = 0;                 // rad, > 0 downhill
  double hip_mass = 0.68;           // kg
  double leg_mass = 0.16;           // kg, each
  double leg_inertia = 0.01700416;  // kg m^2, about the leg's centre of mass
  double hip_to_arc = 0.7;          // m, hip to the foot's arc centre
  double com_below_hip = 0.355;     // m
  double foot_radius = 0.3;         // m
  double hip_stiffness = 0;         // N m/rad, on the angle between the legs
  double toe_off_impulse = 0;       // N s
  double widest_spread = 0;         // rad, largest angle between the legs; 0: no limit
  bool may_fly = false;             // release the stance foot when the ground would pull
};
Linkage straight_legged(const StraightLeggedParameters& parameters);

// The use of knees and feet in a kneed walker.
struct KneedStyle {
  bool latched = false;  // passive walkers: see Linkage::latched
  bool may_fly = true;   // running
};

// Torso, two thighs, two shanks; q = (torso, stance thigh, swing thigh, stance shank, swing shank).
// A torso without inertia whose mass is at the hip has no angle: q then begins with the stance
// thigh.
Linkage kneed(const KneedParameters& parameters, const KneedControls& controls,
              const KneedStyle& style);

}  // namespace walker
}  // namespace walktrack
