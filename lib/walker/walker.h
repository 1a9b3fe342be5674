// The interface of all planar walkers: a hybrid system of smooth phases and events. A phase has
// coordinates q and accelerations; a guard that falls through zero ends it; the event's map gives
// the state after it. simulate.h simulates any walker, limit_cycle.h finds its gaits.
//
// Plane and angles as in core/conventions.h: x forward, z up, the ground is z = 0, a slope tilts
// gravity. A walker contains its parameters and its controls and never changes; the state is in
// WalkerState.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "mechanics/planar.h"

namespace walktrack {
inline namespace walker {

// kFallen and kDiverged are states like any other, at which a simulation stops.
enum class Health { kSound, kFallen, kDiverged };

struct WalkerState {
  Eigen::VectorXd q, qd;         // coordinates of the phase and their rates, SI
  int phase = 0;                 // defined by the model
  unsigned active = 0;           // bit i: limit i is active
  std::vector<double> contacts;  // m, positions of feet as the model needs them
  double time = 0;               // s
  Health health = Health::kSound;
};

enum class EventKind {
  kStrike,   // a foot lands and becomes the supporting foot
  kTakeOff,  // a foot leaves the ground
  kStop,     // a limit is reached (knee stop, latch)
  kRelease,  // a limit would have to pull and is released
  kApex,     // highest point of the centre of mass
  kFall,     // the walker has fallen
};

// An event happens when `value` falls through zero. `rate` is its time derivative if known, with
// which a guard is found that is negative for a short time within one step (grazing).
struct Guard {
  int id = 0;  // unique within one phase
  double value = 0;
  std::optional<double> rate;
};

struct Transition {
  EventKind kind = EventKind::kStrike;
  int index = 0;  // index of the limit or foot
  WalkerState after;
  Eigen::Vector2d impulse = Eigen::Vector2d::Zero();  // N s, of the ground on the landing foot
  double actuator_work = 0;                           // J, done by an impulsive actuator
  double advance = 0;     // m, travel of the body since the last completed step
  double feet_apart = 0;  // m, between the feet's arc centres at a strike
  bool completes_step = false;
  bool old_foot_lifts = true;  // false: the leaving foot would have to go through the ground
};

struct WalkerEnergy {
  double kinetic = 0, gravity = 0, elastic = 0;  // J; gravity is zero at the origin
  double total() const { return kinetic + gravity + elastic; }
};

struct ContactForce {
  Eigen::Vector2d point;  // m, point of contact
  Eigen::Vector2d force;  // N, of the ground on the walker
};

// A line of a drawing.
struct Stroke {
  Eigen::Vector2d from, to;
  int group = 0;  // 0 trunk, 1 stance leg, 2 swing leg
};

class Walker {
 public:
  virtual ~Walker() = default;

  // Names of q, e.g. "stance_thigh", in the phase with most coordinates.
  virtual std::vector<std::string> coordinates() const = 0;
  virtual size_t section_size() const = 0;  // number of coordinates q of a state on the section
  virtual double weight() const = 0;        // N

  // A consistent state: limits in contact push or are released, and no rate leads through one.
  virtual WalkerState settled(WalkerState state) const = 0;

  virtual Eigen::VectorXd acceleration(const WalkerState& state) const = 0;
  virtual std::vector<Guard> guards(const WalkerState& state) const = 0;

  // The state after the event of guard `id`; nullopt if the crossing has no effect (a foot that
  // passes the ground behind the body).
  virtual std::optional<Transition> event(int id, const WalkerState& state) const = 0;

  virtual WalkerEnergy energy(const WalkerState& state) const = 0;
  // Power of each joint's torque, W, including its spring: their sum is d(kinetic + gravity)/dt.
  // Empty for walkers with passive springs, whose total energy is conserved.
  virtual Eigen::VectorXd actuator_powers(const WalkerState& state) const = 0;
  virtual std::vector<ContactForce> contact_forces(const WalkerState& state) const = 0;
  virtual PlanarMomentum momentum(const WalkerState& state) const = 0;
  virtual std::vector<Stroke> strokes(const WalkerState& state) const = 0;

  // The consistent state on the section of a step (just after support transfer, or at the apex)
  // with these coordinates and rates.
  virtual WalkerState section_state(const Eigen::VectorXd& q, const Eigen::VectorXd& qd) const = 0;
  // (q, qd) of a state on the section, with positions relative to the walker's place.
  virtual Eigen::VectorXd section_point(const WalkerState& state) const = 0;

  // Rows to which a difference (dq, dqd) of two nearby states of the section is orthogonal: a foot
  // on the ground, a knee at its stop, a conserved energy.
  virtual Eigen::MatrixXd section_rows(const WalkerState& state) const = 0;
};

}  // namespace walker
}  // namespace walktrack
