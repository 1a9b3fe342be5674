// The walker that a Linkage describes, used for all models with feet. The hand-written kernel of
// the kneed walker (kneed_walker.h) is tested against it.
//
// Phases: kStance has the n angles as coordinates, with the arc centre of the stance foot at
// (contact + R q_foot, R) rolling without slip; kFlight has the angles and the hip's x and z.
// contacts[0] is that contact reference.
//
// Support transfer with the toe-off impulse S on the old foot: with T the Jacobian of the parts'
// coordinates for standing on the new foot, M the parts' masses and v their velocities before,
//   (T' M T) qd+ = T' M v + S-term   (latched limits stacked below as an augmented system),
// then stance and swing leg swap. Stops act afterwards by their own plastic impulse.
#pragma once

#include "walker/linkage/linkage.h"
#include "walker/walker.h"

namespace walktrack {
inline namespace walker {

class LinkageWalker : public Walker {
 public:
  enum Phase { kStance, kFlight };

  explicit LinkageWalker(Linkage linkage);

  const Linkage& linkage() const { return linkage_; }
  TmtSystem system(const WalkerState& state) const;  // with springs, without limits
  LimitedMotion limited_motion(const WalkerState& state) const;
  // Heights of the arc centres above their height at contact, and distance in front of the other
  // foot.
  double foot_height(const WalkerState& state, bool swing) const;
  double swing_lead(const WalkerState& state) const;
  // The strike of the swing foot (or of the stance foot, after flight), whatever its height.
  Transition strike(const WalkerState& state, bool swing) const;

  std::vector<std::string> coordinates() const override;
  size_t section_size() const override { return linkage_.angles.size(); }
  double weight() const override;
  WalkerState settled(WalkerState state) const override;
  Eigen::VectorXd acceleration(const WalkerState& state) const override;
  std::vector<Guard> guards(const WalkerState& state) const override;
  std::optional<Transition> event(int id, const WalkerState& state) const override;
  WalkerEnergy energy(const WalkerState& state) const override;
  Eigen::VectorXd actuator_powers(const WalkerState& state) const override;
  std::vector<ContactForce> contact_forces(const WalkerState& state) const override;
  PlanarMomentum momentum(const WalkerState& state) const override;
  std::vector<Stroke> strokes(const WalkerState& state) const override;
  WalkerState section_state(const Eigen::VectorXd& q, const Eigen::VectorXd& qd) const override;
  Eigen::VectorXd section_point(const WalkerState& state) const override;
  Eigen::MatrixXd section_rows(const WalkerState& state) const override;

 private:
  // The linkage in the world for one set of coordinates.
  struct Placed {
    std::vector<PlanarPart> parts;
    PlanarPoint hip{0}, stance_foot{0}, swing_foot{0};
  };
  Placed placed(const PlanarPoint& hip, Eigen::Index coordinates) const;
  const Placed& frame(const WalkerState& state) const {
    return state.phase == kStance ? on_stance_foot_ : in_flight_;
  }
  Eigen::VectorXd spring_force(const WalkerState& state) const;
  std::vector<Limit> limits_for(const WalkerState& state) const;
  std::vector<LimitRole> acting_roles(const WalkerState& state) const;
  bool is_latched(const WalkerState& state, size_t limit) const;
  double gap(const WalkerState& state, size_t limit) const;
  double gap_rate(const WalkerState& state, size_t limit) const;
  double normal_force(const WalkerState& state) const;
  WalkerState with_plastic_stops(WalkerState state) const;
  WalkerState taken_off(const WalkerState& state, double& work) const;
  // The toe-off impulse at the arc centre `foot`: as a force impulse (N s), as a generalised
  // impulse, and the Jacobian of that point.
  struct ToeOff {
    Eigen::Vector2d impulse;
    Eigen::VectorXd generalised;
    Eigen::MatrixXd lever;
  };
  ToeOff toe_off(const Placed& placed, const PlanarPoint& foot, const Eigen::VectorXd& q) const;
  void transfer_support(const WalkerState& state, bool swing, WalkerState& stance,
                        Transition& transition) const;
  void mirror_legs(WalkerState& stance) const;
  Transition stopped(const WalkerState& state, size_t limit) const;

  Linkage linkage_;
  Eigen::Index n_;
  Placed on_stance_foot_, on_swing_foot_, in_flight_;
};

}  // namespace walker
}  // namespace walktrack
