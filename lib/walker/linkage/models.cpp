#include "walker/linkage/models.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/conventions.h"

namespace walktrack {
inline namespace walker {
namespace {

using Eigen::Index;
using Eigen::Vector2d;
using Eigen::VectorXd;

// A walker whose hip is lower than this share of the standing height has fallen: people walk above
// .85 of it.
constexpr double kFallenShare = 0.6;

constexpr int kMostSpokes = 60;  // by hand: more cannot be distinguished in an image

Vector2d gravity_vector(double gravity, double slope) {
  return gravity * Vector2d(std::sin(slope), -std::cos(slope));
}

VectorXd unit(Index n, Index i) { return VectorXd::Unit(n, i); }

// Adds the sole for drawing: the arc that is in contact while its part leans from -.4 to .7 rad.
void add_sole(Linkage& linkage, const PlanarPoint& centre, Index angle, int group) {
  if (linkage.foot_radius == 0) return;
  constexpr int kPieces = 6;  // of the drawn arc, by hand
  const Index n = centre.along.size();
  const auto point = [&](int piece) {
    const double s = -.4 + 1.1 * piece / kPieces;
    return centre +
           bar(n, angle, -linkage.foot_radius * std::cos(s), linkage.foot_radius * std::sin(s));
  };
  for (int i = 0; i < kPieces; ++i) linkage.lines.push_back({point(i), point(i + 1), group});
}

PlanarPoint origin(Index n) { return PlanarPoint(n); }

// The indices of the kneed walker's angles in q (without a torso the legs come first), and its
// points as functions of them.
struct KneedChain {
  explicit KneedChain(const KneedParameters& parameters)
      : p(parameters),
        has_torso(p.torso.inertia > 0 || p.torso.com_above_hip != 0),
        n(has_torso ? 5 : 4),
        thigh{n - 4, n - 3},
        shank{n - 2, n - 1} {}

  PlanarPoint knee(size_t leg) const { return bar(n, thigh[leg], -p.thigh_length); }
  PlanarPoint ankle(size_t leg) const { return knee(leg) + bar(n, shank[leg], -p.shank_length); }
  PlanarPoint foot(size_t leg) const {
    return ankle(leg) + bar(n, shank[leg], p.foot_up, p.foot_forward);
  }
  PlanarPart thigh_part(size_t leg) const {
    return {p.thigh.mass, p.thigh.inertia, bar(n, thigh[leg], -p.thigh.com_below_hip), thigh[leg]};
  }
  PlanarPart shank_part(size_t leg) const {
    const PlanarPoint com =
        ankle(leg) + bar(n, shank[leg], p.shank.com_above_ankle, p.shank.com_forward);
    return {p.shank.mass, p.shank.inertia, com, shank[leg]};
  }
  PlanarPart torso_part() const {
    const PlanarPoint com = has_torso ? bar(n, 0, p.torso.com_above_hip) : origin(n);
    return {p.torso.mass, p.torso.inertia, com, has_torso ? 0 : Index{-1}};
  }
  VectorXd hip_angle() const { return unit(n, thigh[0]) - unit(n, thigh[1]); }
  VectorXd knee_angle(size_t leg) const { return unit(n, shank[leg]) - unit(n, thigh[leg]); }

  const KneedParameters& p;
  bool has_torso;
  Index n;
  std::array<Index, 2> thigh, shank;  // stance, swing
};

void add_springs(const KneedChain& chain, const KneedControls& controls, Linkage& linkage) {
  const auto add = [&](const VectorXd& measure, const VectorXd& pull, const SpringDamper& law) {
    linkage.springs.push_back({measure, pull, law.stiffness, law.damping, law.rest});
  };
  if (chain.has_torso) {
    const VectorXd torso = unit(chain.n, 0);
    add(torso, torso - unit(chain.n, chain.thigh[0]), controls.torso);
  }
  add(chain.hip_angle(), chain.hip_angle(), controls.hip);
  add(chain.knee_angle(0), chain.knee_angle(0), controls.stance_knee);
  add(chain.knee_angle(1), chain.knee_angle(1), controls.swing_knee);
}

void add_lines(const KneedChain& chain, Linkage& linkage) {
  if (chain.has_torso)
    linkage.lines.push_back(
        {origin(chain.n), bar(chain.n, 0, 1.6 * chain.p.torso.com_above_hip), 0});
  for (size_t leg = 0; leg < 2; ++leg) {
    const int group = static_cast<int>(leg) + 1;
    linkage.lines.push_back({origin(chain.n), chain.knee(leg), group});
    linkage.lines.push_back({chain.knee(leg), chain.ankle(leg), group});
    add_sole(linkage, chain.foot(leg), chain.shank[leg], group);
  }
}

}  // namespace

Linkage rimless_wheel(const RimlessWheelParameters& p) {
  Linkage linkage;
  linkage.angles = {"spoke"};
  linkage.parts = {{p.mass, p.mass * p.gyration * p.gyration, origin(1), 0}};
  // The next spoke is 2 a in front: u(q - 2a) = cos 2a u(q) - sin 2a w(q).
  const double c = std::cos(2 * p.half_angle), s = std::sin(2 * p.half_angle);
  linkage.stance_foot = bar(1, 0, -p.spoke);
  linkage.swing_foot = bar(1, 0, -p.spoke * c, p.spoke * s);
  linkage.gravity = gravity_vector(p.gravity, p.slope);
  linkage.exchange = {0};
  linkage.shift = VectorXd::Constant(1, -2 * p.half_angle);
  linkage.may_scuff = true;
  linkage.lowest_hip = 0.5 * p.spoke * std::cos(p.half_angle);
  linkage.lines = {{linkage.stance_foot, origin(1), 1}, {origin(1), linkage.swing_foot, 2}};
  const int spokes = std::min(kMostSpokes, static_cast<int>(std::lround(kPi / p.half_angle)));
  for (int i = 2; i < spokes; ++i) {
    const double angle = 2 * i * p.half_angle;
    const PlanarPoint tip = bar(1, 0, -p.spoke * std::cos(angle), p.spoke * std::sin(angle));
    linkage.lines.push_back({origin(1), tip, 0});
  }
  return linkage;
}

Linkage straight_legged(const StraightLeggedParameters& p) {
  Linkage linkage;
  linkage.angles = {"stance_leg", "swing_leg"};
  linkage.parts = {{p.hip_mass, 0, origin(2), -1},
                   {p.leg_mass, p.leg_inertia, bar(2, 0, -p.com_below_hip), 0},
                   {p.leg_mass, p.leg_inertia, bar(2, 1, -p.com_below_hip), 1}};
  linkage.stance_foot = bar(2, 0, -p.hip_to_arc);
  linkage.swing_foot = bar(2, 1, -p.hip_to_arc);
  linkage.stance_angle = 0;
  linkage.swing_angle = 1;
  linkage.foot_radius = p.foot_radius;
  linkage.gravity = gravity_vector(p.gravity, p.slope);
  linkage.exchange = {1, 0};
  linkage.shift = VectorXd::Zero(2);
  const VectorXd spread = unit(2, 0) - unit(2, 1);
  if (p.hip_stiffness != 0) linkage.springs = {{spread, spread, p.hip_stiffness, 0, 0}};
  linkage.toe_off_impulse = p.toe_off_impulse;
  if (p.widest_spread > 0) {
    linkage.limits = {{spread, -p.widest_spread}, {-spread, -p.widest_spread}};
  }
  linkage.may_scuff = true;
  linkage.may_fly = p.may_fly;
  linkage.lowest_hip = kFallenShare * p.hip_to_arc + p.foot_radius;
  // Legs down to their soles.
  const double length = p.hip_to_arc + p.foot_radius;
  linkage.lines = {{bar(2, 0, -length), origin(2), 1}, {origin(2), bar(2, 1, -length), 2}};
  add_sole(linkage, linkage.stance_foot, 0, 1);
  add_sole(linkage, linkage.swing_foot, 1, 2);
  return linkage;
}

Linkage kneed(const KneedParameters& p, const KneedControls& controls, const KneedStyle& style) {
  const KneedChain chain(p);
  Linkage linkage;
  if (chain.has_torso) linkage.angles = {"torso"};
  for (const char* name : {"stance_thigh", "swing_thigh", "stance_shank", "swing_shank"})
    linkage.angles.emplace_back(name);
  linkage.parts = {chain.torso_part(), chain.thigh_part(0), chain.thigh_part(1),
                   chain.shank_part(0), chain.shank_part(1)};
  linkage.stance_foot = chain.foot(0);
  linkage.swing_foot = chain.foot(1);
  linkage.stance_angle = chain.shank[0];
  linkage.swing_angle = chain.shank[1];
  linkage.foot_radius = p.foot_radius;
  linkage.gravity = gravity_vector(p.gravity, p.slope);
  linkage.exchange = {chain.thigh[1], chain.thigh[0], chain.shank[1], chain.shank[0]};
  if (chain.has_torso) linkage.exchange.insert(linkage.exchange.begin(), 0);
  linkage.shift = VectorXd::Zero(chain.n);
  add_springs(chain, controls, linkage);
  linkage.toe_off_impulse = controls.toe_off_impulse;
  linkage.limits = {{chain.knee_angle(0), 0}, {chain.knee_angle(1), 0}};
  linkage.latched = style.latched;
  linkage.may_fly = style.may_fly;
  linkage.lowest_hip = kFallenShare * standing_hip_height(p);
  add_lines(chain, linkage);
  return linkage;
}

}  // namespace walker
}  // namespace walktrack
