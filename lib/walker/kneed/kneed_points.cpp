#include "walker/kneed/kneed_points.h"

namespace walktrack {
inline namespace walker {
namespace {

KneedPoint stance_ankle_point(const KneedParameters& p) {
  KneedPoint point;
  point.along[kStanceShank] = -p.foot_up;
  point.across[kStanceShank] = -p.foot_forward;
  return point;
}

KneedPoint moved(KneedPoint point, KneedAngle part, double along, double across = 0) {
  point.along[part] += along;
  point.across[part] += across;
  return point;
}

KneedPoint stance_knee_point(const KneedParameters& p) {
  return moved(stance_ankle_point(p), kStanceShank, p.shank_length);
}
KneedPoint swing_knee_point(const KneedParameters& p) {
  return moved(hip_point(p), kSwingThigh, -p.thigh_length);
}
KneedPoint swing_ankle_point(const KneedParameters& p) {
  return moved(swing_knee_point(p), kSwingShank, -p.shank_length);
}

}  // namespace

KneedPoint hip_point(const KneedParameters& p) {
  return moved(stance_knee_point(p), kStanceThigh, p.thigh_length);
}

KneedPoint swing_foot_point(const KneedParameters& p) {
  return moved(swing_ankle_point(p), kSwingShank, p.foot_up, p.foot_forward);
}

std::array<KneedPoint, 5> part_centres(const KneedParameters& p) {
  const KneedPoint hip = hip_point(p);
  const KneedShank& s = p.shank;
  return {moved(hip, kTorso, p.torso.com_above_hip),
          moved(hip, kStanceThigh, -p.thigh.com_below_hip),
          moved(hip, kSwingThigh, -p.thigh.com_below_hip),
          moved(stance_ankle_point(p), kStanceShank, s.com_above_ankle, s.com_forward),
          moved(swing_ankle_point(p), kSwingShank, s.com_above_ankle, s.com_forward)};
}

std::array<double, 5> part_masses(const KneedParameters& p) {
  return {p.torso.mass, p.thigh.mass, p.thigh.mass, p.shank.mass, p.shank.mass};
}

std::array<double, 5> part_inertias(const KneedParameters& p) {
  return {p.torso.inertia, p.thigh.inertia, p.thigh.inertia, p.shank.inertia, p.shank.inertia};
}

PointJacobian point_jacobian(const KneedPoint& point, const KneedTrig& trig, double foot_radius) {
  PointJacobian jacobian;
  for (int k = 0; k < 5; ++k) {
    jacobian(0, k) = point.along[k] * trig.cosine[k] - point.across[k] * trig.sine[k];
    jacobian(1, k) = -point.along[k] * trig.sine[k] - point.across[k] * trig.cosine[k];
  }
  jacobian(0, kStanceShank) += foot_radius;
  return jacobian;
}

Vector2 point_position(const KneedPoint& point, const KneedTrig& trig, const KneedParameters& p,
                       const KneedState& state) {
  Vector2 position(state.contact_x + p.foot_radius * state.q[kStanceShank], p.foot_radius);
  position.x() += point.along.dot(trig.sine) + point.across.dot(trig.cosine);
  position.y() += point.along.dot(trig.cosine) - point.across.dot(trig.sine);
  return position;
}

KneedPosture kneed_posture(const KneedModel& model, const KneedState& state) {
  const KneedParameters& p = model.parameters;
  const KneedTrig trig(state.q);
  const auto at = [&](const KneedPoint& point) { return point_position(point, trig, p, state); };
  return {.stance_foot = at(KneedPoint{}),
          .stance_ankle = at(stance_ankle_point(p)),
          .stance_knee = at(stance_knee_point(p)),
          .hip = at(hip_point(p)),
          .torso_com = at(part_centres(p)[kTorso]),
          .swing_knee = at(swing_knee_point(p)),
          .swing_ankle = at(swing_ankle_point(p)),
          .swing_foot = at(swing_foot_point(p))};
}

SwingFoot kneed_swing_foot(const KneedModel& model, const KneedState& state) {
  const KneedParameters& p = model.parameters;
  const KneedTrig trig(state.q);
  const KneedPoint foot = swing_foot_point(p);
  const Vector2 position = point_position(foot, trig, p, state);
  const Vector2 rate = point_jacobian(foot, trig, p.foot_radius) * state.qd;
  return {.height = position.y() - p.foot_radius,
          .lead = position.x() - state.contact_x - p.foot_radius * state.q[kStanceShank],
          .height_rate = rate.y(),
          .lead_rate = rate.x() - p.foot_radius * state.qd[kStanceShank]};
}

}  // namespace walker
}  // namespace walktrack
