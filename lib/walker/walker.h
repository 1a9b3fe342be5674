// The one interface of all planar walkers: a hybrid system of smooth phases and events. A phase has
// coordinates q and accelerations; a guard that falls through zero ends it; the event's map gives
// the state after it. simulate.h moves any walker through time, limit_cycle.h finds its gaits.
//
// Plane and angles as in core/conventions.h: x forward, z up, the ground is z = 0, a slope tilts
// gravity. A walker holds its parameters and its controls and never changes; all that changes is
// in WalkerState.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "mechanics/planar.h"

namespace walktrack {
inline namespace walker {

// kFallen and kDiverged are states like any other: whoever simulates stops there.
enum class Health { kSound, kFallen, kDiverged };

struct WalkerState {
  Eigen::VectorXd q, qd;         // coordinates of the phase and their rates, SI
  int phase = 0;                 // meaning given by the model
  unsigned active = 0;           // bit i: limit i acts
  std::vector<double> contacts;  // m, what the model needs to know of where its feet stand
  double time = 0;               // s
  Health health = Health::kSound;
};

enum class EventKind {
  kStrike,   // a foot lands and takes over
  kTakeOff,  // a foot leaves the ground
  kStop,     // a limit is reached (knee stop, latch)
  kRelease,  // a limit would have to pull and lets go
  kApex,     // highest point of the centre of mass
  kFall,     // the walker has fallen
};

// `value` falls through zero when the event happens. `rate` is its time derivative where known; it
// serves to see a guard that dips below zero and returns within one step (grazing).
struct Guard {
  int id = 0;  // distinct within one phase
  double value = 0;
  std::optional<double> rate;
};

struct Transition {
  EventKind kind = EventKind::kStrike;
  int index = 0;  // which limit or foot
  WalkerState after;
  Eigen::Vector2d impulse = Eigen::Vector2d::Zero();  // N s, of the ground on the landing foot
  double actuator_work = 0;                           // J, done by an impulsive actuator
  double advance = 0;     // m, how far the body came since the last completed step
  double feet_apart = 0;  // m, between the feet's arc centres at a strike
  bool completes_step = false;
  bool old_foot_lifts = true;  // false: the leaving foot would have to go through the ground
};

struct WalkerEnergy {
  double kinetic = 0, gravity = 0, elastic = 0;  // J; gravity is zero at the origin
  double total() const { return kinetic + gravity + elastic; }
};

struct ContactForce {
  Eigen::Vector2d point;  // m, where the ground is touched
  Eigen::Vector2d force;  // N, of the ground on the walker
};

// A line to draw, from one point to another.
struct Stroke {
  Eigen::Vector2d from, to;
  int group = 0;  // 0 trunk, 1 stance leg, 2 swing leg
};

class Walker {
 public:
  virtual ~Walker() = default;

  // Names of q, e.g. "stance_thigh"; of the phase that has most coordinates.
  virtual std::vector<std::string> coordinates() const = 0;
  virtual size_t section_size() const = 0;  // number of coordinates q of a state on the section
  virtual double weight() const = 0;        // N

  // A state made consistent: limits that touch push or let go, and no rate leads through one.
  virtual WalkerState settled(WalkerState state) const = 0;

  virtual Eigen::VectorXd acceleration(const WalkerState& state) const = 0;
  virtual std::vector<Guard> guards(const WalkerState& state) const = 0;

  // The state after the event of guard `id`; nullopt where the crossing means nothing (a foot that
  // passes the ground behind the body).
  virtual std::optional<Transition> event(int id, const WalkerState& state) const = 0;

  virtual WalkerEnergy energy(const WalkerState& state) const = 0;
  // Power of each joint's torque, W, its spring included: their sum is d(kinetic + gravity)/dt.
  // Empty for walkers whose springs are passive; there the total energy is conserved.
  virtual Eigen::VectorXd actuator_powers(const WalkerState& state) const = 0;
  virtual std::vector<ContactForce> contact_forces(const WalkerState& state) const = 0;
  virtual PlanarMomentum momentum(const WalkerState& state) const = 0;
  virtual std::vector<Stroke> strokes(const WalkerState& state) const = 0;

  // The state on the section of a step (just after support transfer, or at the apex) with these
  // coordinates and rates, settled.
  virtual WalkerState section_state(const Eigen::VectorXd& q, const Eigen::VectorXd& qd) const = 0;
  // (q, qd) of a state on the section, positions counted from where the walker stands.
  virtual Eigen::VectorXd section_point(const WalkerState& state) const = 0;

  // Rows that a difference (dq, dqd) of two nearby states of the section is orthogonal to: a foot
  // on the ground, a knee at its stop, an energy that is conserved.
  virtual Eigen::MatrixXd section_rows(const WalkerState& state) const = 0;
};

}  // namespace walker
}  // namespace walktrack
