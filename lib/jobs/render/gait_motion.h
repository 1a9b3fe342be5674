// A walk of the kneed walker in three dimensions, with its ground reactions: a motion for
// `walktrack render` whose truth includes forces.
//
// The walker walks in a vertical plane. Hips and feet are half a hip width to either side of it.
// The supporting foot is placed where the walker's round foot rolls (rolled_ankle of
// tracker/state/particle.h), a swinging foot as if it were on the ground. Arms swing opposite to
// the legs; their mass is in the walker's torso. One foot is on the ground at a time: support is
// transferred in an instant, by the impulses of toe-off and heel strike.
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

// The state at one time of the simulation, in the plane of walking: (forward, up).
struct GroundRecord {
  double time;
  Side stance;
  Eigen::Vector2d com, contact;            // m
  std::array<Eigen::Vector2d, 2> impulse;  // N s, of the ground on either foot so far
  double kinetic, potential;               // J
};

struct WalkedGait {
  Motion motion;                     // from before time 0 to after the duration
  std::vector<GroundRecord> ground;  // times ascend, and are equal on both sides of an event
  Eigen::Isometry3d world_from_plane;
  double foot_aside;  // m, distance of a foot from the plane
};

// `slope`: gravity is tilted forward by this angle, rad. InputError if the walker falls.
WalkedGait walked_gait(const GaitWalk& walk, const Subject& subject, double slope, double duration);

// Forces at times of the motion: means over `interval` (s) around each time, so that they and the
// weight explain all of the body's momentum, impulses included. Centres of pressure, centre of mass
// and energies are those at the time itself. Moments and powers of joints are NaN, because a person
// would not distribute them as the walker does.
Kinetics ground_kinetics(const WalkedGait& walked, std::span<const double> times, double interval);

}  // namespace jobs
}  // namespace walktrack
