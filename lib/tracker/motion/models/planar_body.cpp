#include "tracker/motion/models/planar_body.h"

#include "core/anthropometry.h"

namespace walktrack {
inline namespace tracker {

KneedParameters kneed_parameters(const Subject& subject, double gravity) {
  const BodyLengths lengths = body_lengths(subject);
  const double leg = leg_length(lengths), mass = subject.mass;
  const auto inertia = [](double part_mass, double gyration) {
    return part_mass * gyration * gyration;
  };
  KneedParameters p;
  p.gravity = gravity;
  p.thigh_length = lengths.thigh;
  p.shank_length = lengths.shank;
  p.foot_radius = 0.3 * leg;
  p.foot_forward = 0.0539 * leg;
  p.foot_up = p.foot_radius - lengths.ankle_height;
  const auto &torso = anthropometry::kHeadArmsTrunk, &thigh = anthropometry::kThighShares,
             &shank = anthropometry::kShankAndFoot;
  p.torso = {torso.mass * mass, torso.centre * lengths.trunk,
             inertia(torso.mass * mass, torso.gyration * lengths.trunk)};
  p.thigh = {thigh.mass * mass, thigh.centre * lengths.thigh,
             inertia(thigh.mass * mass, thigh.gyration * lengths.thigh)};
  p.shank = {shank.mass * mass, (1 - shank.centre) * lengths.shank, 0,
             inertia(shank.mass * mass, shank.gyration * lengths.shank)};
  return p;
}

}  // namespace tracker
}  // namespace walktrack
