#include "gait/walker_units.h"

#include <cmath>

#include "core/anthropometry.h"
#include "core/conventions.h"

namespace walktrack {
inline namespace gait {
namespace {

using namespace anthropometry;

// The rolling foot: its radius as a share of the leg length, with which the centre of pressure of
// people progresses (Adamczyk, Collins & Kuo 2006, J. Exp. Biol. 209, 3953-3963), and the distance
// of its centre in front of the ankle as a share of the stature (by hand).
constexpr double kArcRadius = 0.3;
constexpr double kArcForward = 0.05 / 1.75;

double inertia(double mass, double radius) { return mass * radius * radius; }

}  // namespace

double WalkerUnits::time() const { return std::sqrt(length / gravity); }
double WalkerUnits::speed() const { return std::sqrt(length * gravity); }
double WalkerUnits::torque() const { return mass * gravity * length; }
double WalkerUnits::impulse() const { return mass * speed(); }

KneedParameters adult_walker(double height, double mass, double slope) {
  const double leg = (kThigh + kShank + kAnkleHeight) * height;
  KneedParameters p;
  p.gravity = kStandardGravity;
  p.slope = slope;
  p.thigh_length = kThigh * height;
  p.shank_length = kShank * height;
  p.foot_radius = kArcRadius * leg;
  p.foot_forward = kArcForward * height;
  p.foot_up = p.foot_radius - kAnkleHeight * height;
  const SegmentShares &torso = kHeadArmsTrunk, &thigh = kThighShares, &shank = kShankAndFoot;
  p.torso = {torso.mass * mass, torso.centre * kTrunk * height,
             inertia(torso.mass * mass, torso.gyration * kTrunk * height)};
  p.thigh = {thigh.mass * mass, thigh.centre * p.thigh_length,
             inertia(thigh.mass * mass, thigh.gyration * p.thigh_length)};
  p.shank = {shank.mass * mass, (1 - shank.centre) * p.shank_length, 0,
             inertia(shank.mass * mass, shank.gyration * p.shank_length)};
  return p;
}

KneedParameters unit_walker(double slope) {
  KneedParameters p = adult_walker(1 / (kThigh + kShank + kAnkleHeight), 1, slope);
  p.gravity = 1;
  return p;
}

WalkerUnits walker_units(const KneedParameters& p) {
  return {standing_hip_height(p), p.torso.mass + 2 * (p.thigh.mass + p.shank.mass), p.gravity};
}

KneedControls scaled(const KneedControls& controls, const WalkerUnits& from,
                     const WalkerUnits& to) {
  const double torque = to.torque() / from.torque();
  const double time = to.time() / from.time();
  KneedControls c = controls;
  for (SpringDamper* joint : {&c.torso, &c.hip, &c.stance_knee, &c.swing_knee}) {
    joint->stiffness *= torque;
    joint->damping *= torque * time;
  }
  c.toe_off_impulse *= to.impulse() / from.impulse();
  return c;
}

KneedState scaled(const KneedState& state, const WalkerUnits& from, const WalkerUnits& to) {
  const double length = to.length / from.length, time = to.time() / from.time();
  KneedState s = state;
  s.qd /= time;
  s.contact_x *= length;
  s.clearance *= length;
  s.since_transfer *= time;
  return s;
}

}  // namespace gait
}  // namespace walktrack
