#include "tracker/motion/planar_body.h"

namespace walktrack {

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
  const double torso = .678 * mass, thigh = .100 * mass, shank = .061 * mass;
  p.torso = {torso, .626 * lengths.trunk, inertia(torso, .496 * lengths.trunk)};
  p.thigh = {thigh, .433 * lengths.thigh, inertia(thigh, .323 * lengths.thigh)};
  p.shank = {shank, (1 - .606) * lengths.shank, 0, inertia(shank, .416 * lengths.shank)};
  return p;
}

}  // namespace walktrack
