// A walk of the kneed walker as cameras would see it, with its ground reactions: the motion of
// `walktrack render` whose truth includes forces.
//
// The walker walks in a vertical plane. Hips and feet are half a hip width to either side of it,
// feet lie where its round feet roll (rolled_ankle of tracker/state/particle.h), a swinging foot
// as it would stand. Arms swing against the legs; their mass is in the walker's torso. One foot
// stands at a time: support passes over in an instant, by the impulses of toe-off and strike.
#pragma once

#include <array>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "body/motion.h"
#include "body/subject.h"
#include "io/scene/render_file.h"
#include "kinetics/kinetics.h"

namespace walktrack {
inline namespace jobs {

// One instant of the simulation, in the walking plane: (forward, up).
struct GroundRecord {
  double time;
  Side stance;
  Eigen::Vector2d com, contact;            // m
  std::array<Eigen::Vector2d, 2> impulse;  // N s, of the ground on either foot up to now
  double kinetic, potential;               // J
};

struct WalkedGait {
  Motion motion;                     // from before time 0 to after the duration
  std::vector<GroundRecord> ground;  // times ascend, equal on both sides of an event
  Eigen::Isometry3d world_from_plane;
  double foot_aside;  // m, of a foot from the plane
};

// `slope`: gravity tilts forward by it, rad. InputError when the walker falls on the way.
WalkedGait walked_gait(const GaitWalk& walk, const Subject& subject, double slope, double duration);

// Forces at times of the motion: means over `interval` (s) about each time, so that they and the
// weight account for all of the body's momentum, impulses included. Centres of pressure, centre of
// mass and energies at the time itself. Moments and powers of joints, which a person would not
// share as the walker does, are NaN.
Kinetics ground_kinetics(const WalkedGait& walked, std::span<const double> times, double interval);

}  // namespace jobs
}  // namespace walktrack
