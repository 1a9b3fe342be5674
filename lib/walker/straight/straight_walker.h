// The anthropomorphic walker (McGeer 1990; Kuo 2002; StraightLeggedParameters): two straight legs
// with rolling feet, a point mass at the hip, a spring between the legs, an impulse at toe-off.
// These are its closed forms for particles; straight_batch.h advances many walkers in time. It is
// the walker of straight_legged() without flight and without a limit of the spread.
//
// q = (stance leg, swing leg). With c_jk and a_j the sums over the parts and R the feet's radius,
//   M00 = c00 + R^2 m + 2 R a0 cos q0,  M01 = c01 cos(q0 - q1) + R a1 cos q1,  M11 = c11.
// Both feet are arcs about points at the same distance from the hip, so that the swing foot is on
// the ground if q1 = -q0 or q1 = q0. A strike is q0 + q1 rising through zero with the foot in
// front; contact behind, or while the legs pass each other, is ignored.
#pragma once

#include "walker/linkage/models.h"

namespace walktrack {
inline namespace walker {

// Constant from one support transfer to the next.
struct StraightControls {
  double stiffness = 0;        // N m/rad, of the spring between the legs
  double toe_off_impulse = 0;  // N s, at the transfer that ends the step
};

struct StraightState {
  Vector2 q = Vector2::Zero();   // rad
  Vector2 qd = Vector2::Zero();  // rad/s
  double contact_x = 0;          // m, the ground point below the stance foot's arc centre at q0 = 0
  double since_transfer = 0;     // s
  int transfers = 0;             // number of support transfers
};

// Sums over the parts; distances of points from the stance foot's arc centre are along q0, q1.
struct StraightModel {
  double leg = 0, radius = 0;                  // m, hip to arc centre; of the foot
  double mass = 0;                             // kg
  double gravity_x = 0, gravity_z = 0;         // m/s^2
  double stance_moment = 0, swing_moment = 0;  // kg m, a0 and a1
  double stance_couple = 0, cross_couple = 0, swing_couple = 0;  // kg m^2: c00, c01, c11
  double transfer_leg = 0, transfer_cross = 0;  // kg m^2, between standing on either foot
  double least_hip = 0;                         // m, below it the walker has fallen
};

// Does not include the controls in `parameters`.
StraightModel straight_model(const StraightLeggedParameters& parameters);

// `noise` is a generalised torque, N m.
Vector2 straight_accelerations(const StraightModel& model, double stiffness, const Vector2& noise,
                               const StraightState& state);

// Ground reaction on the stance foot (forward, up), N, for given accelerations.
Vector2 straight_contact_force(const StraightModel& model, const StraightState& state,
                               const Vector2& qdd);

// Support transfer with toe-off like kneed_support_transfer(); the impulse acts along the leg.
struct StraightTransfer {
  StraightState state;  // with stance and swing leg swapped
  Vector2 impulse;      // N s, of the ground on the new stance foot
  double step_length;   // m, between the feet's arc centres
  double toe_off_work;  // J
  bool old_foot_lifts;  // false: it would have to go through the ground
};
StraightTransfer straight_support_transfer(const StraightModel& model, double toe_off_impulse,
                                           const StraightState& before);

}  // namespace walker
}  // namespace walktrack
