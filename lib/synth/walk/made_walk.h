// Generates a walk without a recording: footprints at regular steps along a straight or circular
// path, feet that roll over heel and ball without sliding, a pelvis with people's rotation, list
// and lateral motion whose height follows from the supporting leg, legs by inverse kinematics, and
// swinging arms. It is used for demonstrations and tests; it is kinematic and does not obey
// mechanics. Metres, seconds, radians.
//
// The kinematics, their dependence on speed and the differences between people are in
// walk_style.cpp, with their sources; step length grows with speed to the power 0.42
// (gait/prior/prior_table.h).
#pragma once

#include <cstdint>
#include <optional>

#include <Eigen/Core>

#include "body/body.h"
#include "body/motion.h"

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
  // Seed of a person: people differ in everything that is not stated here. 0 is the average person.
  uint64_t person = 0;
  std::optional<double> step_width;  // m between the tracks of the ankles; the average is 0.09
  std::optional<double> lean;        // of trunk and pelvis, > 0 forwards; the average is 4 degrees
  // Of patients:
  double limp = 0;             // by this share of a step a right foot lands too far ahead and too
                               // late
  double straightest = .9985;  // length of the straightest leg, share of full length: knees never
                               // lock; a smaller value is a crouch
};

// The joints of `body` (with arms if it has them). InputError if its legs are too short for the
// steps.
Motion made_walk(const Body& body, const MadeWalk& walk);

}  // namespace synth
}  // namespace walktrack
