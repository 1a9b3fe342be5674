// A walk without a recording: footprints at regular steps along a straight or circular path, feet
// that roll over heel and ball without sliding, a pelvis that bobs, sways and turns as people's do,
// legs by inverse kinematics, arms that swing. For demonstrations and tests; it obeys geometry, not
// mechanics. Metres, seconds, radians.
//
// Magnitudes after Perry, "Gait Analysis", 1992 (stance 62 % of the stride, sole pitch, pelvic list
// 4 deg and rotation 5 deg, 4 cm of rise and of sway) and Grieve & Gear 1966 (step length grows
// with speed to the power 0.42).
#pragma once

#include <optional>

#include <Eigen/Core>

#include "body/body.h"
#include "body/motion.h"
#include "core/conventions.h"

namespace walktrack {
inline namespace synth {

struct MadeWalk {
  double speed = 1.25;                // m/s, along the path, 0.3 to 2.2
  std::optional<double> step_length;  // m; default: the preferred one, 0.40 H (v / 1.25)^0.42
  double from = 0, to = 4;            // s, times of the first and last row
  double rate = 120;                  // rows per second
  Eigen::Vector2d start{0, 0};        // of the path under the pelvis at time 0
  double heading = 0;                 // of the path at time 0
  double turn_rate = 0;               // of the path, rad/s, > 0 to the left
  double phase = 0;                   // share of the stride since a left foot strike, at time 0
  double arm_swing = 1;               // relative to the usual
  // Of patients:
  double limp = 0;           // a right foot lands that share of a step too far ahead and too late
  double step_width = 0.09;  // m between the tracks of the ankles
  double lean = rad_from_deg(4);  // of trunk and pelvis, > 0 forwards
  double straightest = 0.985;     // of the leg, share of its length: knees never lock
};

// The joints of `body` (with arms if it has them). InputError if its legs cannot take such steps.
Motion made_walk(const Body& body, const MadeWalk& walk);

}  // namespace synth
}  // namespace walktrack
