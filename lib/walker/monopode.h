// The monopode: a point mass on massless spring legs (Blickhan 1989; Blickhan & Full 1993). Running
// has one leg and flight, walking two legs and double support (Geyer, Seyfarth & Blickhan 2006).
//
// q = (x, z) of the mass. A leg lands with its fixed angle of attack when the mass is at leg_length
// * sin(attack) and moves down; it leaves the ground at its rest length. Legs never pull. The
// energy is conserved; the section of a step is the apex (vertical rate falls through zero), in
// flight when running and over one leg when walking.
#pragma once

#include "walker/walker.h"

namespace walktrack {
inline namespace walker {

struct MonopodeParameters {
  double gravity = 9.81;               // m/s^2
  double mass = 80;                    // kg
  double leg_length = 1;               // m, at rest
  double stiffness = 20000;            // N/m
  double attack = 1.1868238913561442;  // rad, of the landing leg over the ground (68 degrees)
  bool walks = false;
};

class Monopode : public Walker {
 public:
  explicit Monopode(const MonopodeParameters& parameters);

  // (q, qd) of the apex at `height` (m) and, when walking, `ahead` (m) of the foot, with the
  // forward speed that gives `energy` (J). nullopt if the energy is too small.
  std::optional<Eigen::VectorXd> apex(double height, double ahead, double energy) const;

  std::vector<std::string> coordinates() const override { return {"x", "z"}; }
  size_t section_size() const override { return 2; }
  double weight() const override { return parameters_.mass * parameters_.gravity; }
  WalkerState settled(WalkerState state) const override { return state; }
  Eigen::VectorXd acceleration(const WalkerState& state) const override;
  std::vector<Guard> guards(const WalkerState& state) const override;
  std::optional<Transition> event(int id, const WalkerState& state) const override;
  WalkerEnergy energy(const WalkerState& state) const override;
  Eigen::VectorXd actuator_powers(const WalkerState&) const override { return {}; }
  std::vector<ContactForce> contact_forces(const WalkerState& state) const override;
  PlanarMomentum momentum(const WalkerState& state) const override;
  std::vector<Stroke> strokes(const WalkerState& state) const override;
  // x is counted from the foot when walking; when running, x is zero at the apex.
  WalkerState section_state(const Eigen::VectorXd& q, const Eigen::VectorXd& qd) const override;
  Eigen::VectorXd section_point(const WalkerState& state) const override;
  Eigen::MatrixXd section_rows(const WalkerState& state) const override;

 private:
  Eigen::Vector2d leg_force(const WalkerState& state, double foot) const;
  WalkerState landed(const WalkerState& state) const;

  // contacts[0] is the beginning of the step, followed by the feet on the ground, the trailing one
  // first. The `active` bit is set from an apex to the next landing.
  MonopodeParameters parameters_;
  std::vector<PlanarPart> parts_;
};

}  // namespace walker
}  // namespace walktrack
