#include "walker/linkage/models.h"

#include <algorithm>
#include <cmath>

#include "core/conventions.h"

namespace walktrack {
inline namespace walker {
namespace {

using Eigen::Index;
using Eigen::Vector2d;
using Eigen::VectorXd;

// A hip lower than this share of the standing height has fallen: people walk above .85 of it.
constexpr double kFallenShare = 0.6;

constexpr int kMostSpokes = 60;  // more cannot be told apart in a picture

Vector2d gravity_vector(double gravity, double slope) {
  return gravity * Vector2d(std::sin(slope), -std::cos(slope));
}

VectorXd unit(Index n, Index i) { return VectorXd::Unit(n, i); }

// The sole to draw: the arc that rolls while its part leans from -.4 to .7 rad.
void add_sole(Linkage& linkage, const PlanarPoint& centre, Index angle, int group) {
  if (linkage.foot_radius == 0) return;
  constexpr int kPieces = 6;
  const Index n = centre.along.size();
  const auto point = [&](int piece) {
    const double s = -.4 + 1.1 * piece / kPieces;
    return centre +
           bar(n, angle, -linkage.foot_radius * std::cos(s), linkage.foot_radius * std::sin(s));
  };
  for (int i = 0; i < kPieces; ++i) linkage.lines.push_back({point(i), point(i + 1), group});
}

PlanarPoint origin(Index n) { return PlanarPoint(n); }

}  // namespace

Linkage rimless_wheel(const RimlessWheelParameters& p) {
  Linkage linkage;
  linkage.angles = {"spoke"};
  linkage.parts = {{p.mass, p.mass * p.gyration * p.gyration, origin(1), 0}};
  // The next spoke points 2 a ahead: u(q - 2a) = cos 2a u(q) - sin 2a w(q).
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
  // Indices of q; without a torso angle the legs come first.
  const bool has_torso = p.torso.inertia > 0 || p.torso.com_above_hip != 0;
  const Index n = has_torso ? 5 : 4, first = has_torso ? 1 : 0;
  const Index thigh1 = first, thigh2 = first + 1, shank1 = first + 2, shank2 = first + 3;
  const double h = p.foot_up;

  const auto knee = [&](Index thigh) { return bar(n, thigh, -p.thigh_length); };
  const auto ankle = [&](Index thigh, Index shank) {
    return knee(thigh) + bar(n, shank, -p.shank_length);
  };
  const auto foot = [&](Index thigh, Index shank) {
    return ankle(thigh, shank) + bar(n, shank, h, p.foot_forward);
  };
  const auto thigh_part = [&](Index thigh) {
    return PlanarPart{p.thigh.mass, p.thigh.inertia, bar(n, thigh, -p.thigh.com_below_hip), thigh};
  };
  const auto shank_part = [&](Index thigh, Index shank) {
    const PlanarPoint com =
        ankle(thigh, shank) + bar(n, shank, p.shank.com_above_ankle, p.shank.com_forward);
    return PlanarPart{p.shank.mass, p.shank.inertia, com, shank};
  };

  Linkage linkage;
  if (has_torso) linkage.angles = {"torso"};
  for (const char* name : {"stance_thigh", "swing_thigh", "stance_shank", "swing_shank"}) {
    linkage.angles.emplace_back(name);
  }
  const PlanarPoint torso = has_torso ? bar(n, 0, p.torso.com_above_hip) : origin(n);
  linkage.parts = {{p.torso.mass, p.torso.inertia, torso, has_torso ? 0 : Index{-1}},
                   thigh_part(thigh1),
                   thigh_part(thigh2),
                   shank_part(thigh1, shank1),
                   shank_part(thigh2, shank2)};
  linkage.stance_foot = foot(thigh1, shank1);
  linkage.swing_foot = foot(thigh2, shank2);
  linkage.stance_angle = shank1;
  linkage.swing_angle = shank2;
  linkage.foot_radius = p.foot_radius;
  linkage.gravity = gravity_vector(p.gravity, p.slope);
  linkage.exchange = {thigh2, thigh1, shank2, shank1};
  if (has_torso) linkage.exchange.insert(linkage.exchange.begin(), 0);
  linkage.shift = VectorXd::Zero(n);

  const VectorXd hip = unit(n, thigh1) - unit(n, thigh2);
  const VectorXd knee1 = unit(n, shank1) - unit(n, thigh1);
  const VectorXd knee2 = unit(n, shank2) - unit(n, thigh2);
  const auto spring = [](const VectorXd& measure, const VectorXd& pull, const SpringDamper& law) {
    return LinkageSpring{measure, pull, law.stiffness, law.damping, law.rest};
  };
  if (has_torso) {
    linkage.springs.push_back(spring(unit(n, 0), unit(n, 0) - unit(n, thigh1), controls.torso));
  }
  linkage.springs.push_back(spring(hip, hip, controls.hip));
  linkage.springs.push_back(spring(knee1, knee1, controls.stance_knee));
  linkage.springs.push_back(spring(knee2, knee2, controls.swing_knee));
  linkage.toe_off_impulse = controls.toe_off_impulse;

  linkage.limits = {{knee1, 0}, {knee2, 0}};
  linkage.latched = style.latched;
  linkage.may_fly = style.may_fly;
  linkage.lowest_hip = kFallenShare * standing_hip_height(p);
  const auto leg = [&](Index thigh, Index shank, int group) {
    linkage.lines.push_back({origin(n), knee(thigh), group});
    linkage.lines.push_back({knee(thigh), ankle(thigh, shank), group});
    add_sole(linkage, foot(thigh, shank), shank, group);
  };
  if (has_torso) linkage.lines.push_back({origin(n), bar(n, 0, 1.6 * p.torso.com_above_hip), 0});
  leg(thigh1, shank1, 1);
  leg(thigh2, shank2, 2);
  return linkage;
}

}  // namespace walker
}  // namespace walktrack
