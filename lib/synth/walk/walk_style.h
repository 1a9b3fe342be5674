// The style of a walk, from its speed, the body and the person. Metres, seconds, radians.
#pragma once

#include "body/body.h"
#include "synth/walk/made_walk.h"
#include "synth/walk/periodic_curve.h"

namespace walktrack {
inline namespace synth {

struct WalkStyle {
  double step_length, step_width;
  double lean;
  double lift;               // share of the stride at which the ball leaves the ground
  PeriodicCurve sole_pitch;  // over the stride from the strike, > 0 heel up
  PeriodicCurve knee;        // flexion of the supporting leg's knee, over the stride
  double clearance;          // of the tip of the toes in mid-swing
  double rotation, list;     // of the pelvis, amplitudes
  double arm_swing;          // of the shoulder, amplitude
};

WalkStyle walk_style(const Body& body, const MadeWalk& walk);

}  // namespace synth
}  // namespace walktrack
