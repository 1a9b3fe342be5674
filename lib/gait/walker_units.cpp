#include "gait/walker_units.h"

#include <cmath>

#include "core/conventions.h"

namespace walktrack {
namespace {

// Lengths as shares of the stature, masses of the body mass, centres and gyration of the segment.
constexpr double kThigh = 0.245, kShank = 0.246, kAnkle = 0.039, kTrunk = 0.288;
constexpr double kTrunkMass = 0.678, kThighMass = 0.100, kShankMass = 0.061;
constexpr double kTrunkCentre = 0.626, kThighCentre = 0.433, kShankCentre = 0.606;
constexpr double kTrunkGyration = 0.496, kThighGyration = 0.323, kShankGyration = 0.416;
constexpr double kArcRadius = 0.3;           // of the leg length
constexpr double kArcForward = 0.05 / 1.75;  // of the stature

double inertia(double mass, double radius) { return mass * radius * radius; }

}  // namespace

double WalkerUnits::time() const { return std::sqrt(length / gravity); }
double WalkerUnits::speed() const { return std::sqrt(length * gravity); }
double WalkerUnits::torque() const { return mass * gravity * length; }
double WalkerUnits::impulse() const { return mass * speed(); }

KneedParameters adult_walker(double height, double mass, double slope) {
  const double leg = (kThigh + kShank + kAnkle) * height;
  KneedParameters p;
  p.gravity = kStandardGravity;
  p.slope = slope;
  p.thigh_length = kThigh * height;
  p.shank_length = kShank * height;
  p.foot_radius = kArcRadius * leg;
  p.foot_forward = kArcForward * height;
  p.foot_up = p.foot_radius - kAnkle * height;
  p.torso = {kTrunkMass * mass, kTrunkCentre * kTrunk * height,
             inertia(kTrunkMass * mass, kTrunkGyration * kTrunk * height)};
  p.thigh = {kThighMass * mass, kThighCentre * p.thigh_length,
             inertia(kThighMass * mass, kThighGyration * p.thigh_length)};
  p.shank = {kShankMass * mass, (1 - kShankCentre) * p.shank_length, 0,
             inertia(kShankMass * mass, kShankGyration * p.shank_length)};
  return p;
}

KneedParameters unit_walker(double slope) {
  KneedParameters p = adult_walker(1 / (kThigh + kShank + kAnkle), 1, slope);
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

}  // namespace walktrack
