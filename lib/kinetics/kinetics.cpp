#include "kinetics/kinetics.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "kinetics/linked_body.h"
#include "kinetics/smoothing.h"
#include "mechanics/articulated_dynamics.h"

namespace walktrack {
inline namespace kinetics {

namespace {

using Eigen::Vector3d;

std::vector<Span> linkable_spans(const Motion& motion) {
  std::vector<Span> spans;
  for (size_t i = 0; i < motion.time.size(); ++i) {
    if (!linkable(motion.joints[i])) continue;
    if (spans.empty() || spans.back().end != i) spans.push_back({i, i});
    spans.back().end = i + 1;
  }
  std::erase_if(spans, [](const Span& span) { return span.end - span.begin < kShortestSpan; });
  return spans;
}

struct LegLinks {
  size_t thigh, shank, foot;
};

LegLinks leg_links(const LinkedBody& body, Side side) {
  const bool left = side == Side::kLeft;
  return {body.index(left ? Segment::kLeftThigh : Segment::kRightThigh),
          body.index(left ? Segment::kLeftShank : Segment::kRightShank),
          body.index(left ? Segment::kLeftFoot : Segment::kRightFoot)};
}

Wrench missing_wrench(const InverseDynamics& dynamics, const Vector3d& root) {
  return {dynamics.joint_force[0], dynamics.joint_moment[0] + root.cross(dynamics.joint_force[0])};
}

// The feet's loads as forces on their links.
std::vector<PartForce> part_forces(const LinkedBody& body, const std::vector<PartMotion>& motions,
                                   const std::array<FootLoad, 2>& feet) {
  std::vector<PartForce> out;
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const FootLoad& load = feet[static_cast<size_t>(side)];
    if (!load.centre.allFinite()) continue;
    const size_t part = leg_links(body, side).foot;
    const Vector3d centre(load.centre.x(), load.centre.y(), 0);
    out.push_back({part, motions[part].rotation.transpose() * (centre - motions[part].origin),
                   load.force, Vector3d(0, 0, load.free_moment)});
  }
  return out;
}

// Moments about the anatomical axes: the parent's left for flexions, its front for abduction.
LegLoads leg_loads(const LinkedBody& body, const std::vector<PartMotion>& motions,
                   const std::vector<Vector3d>& moments, Side side) {
  const LegLinks leg = leg_links(body, side);
  const double outward = side == Side::kLeft ? 1 : -1;
  const auto about = [&](size_t part, size_t parent, Eigen::Index axis) {
    return moments[part].dot(motions[parent].rotation.col(axis));
  };
  const auto power = [&](size_t part, size_t parent) {
    return moments[part].dot(motions[part].omega - motions[parent].omega);
  };
  return {.hip_flexion = -about(leg.thigh, 0, 1),
          .hip_abduction = outward * about(leg.thigh, 0, 0),
          .knee_flexion = about(leg.shank, leg.thigh, 1),
          .ankle_dorsiflexion = -about(leg.foot, leg.shank, 1),
          .hip_power = power(leg.thigh, 0),
          .knee_power = power(leg.shank, leg.thigh),
          .ankle_power = power(leg.foot, leg.shank)};
}

std::array<FootPlace, 2> foot_places(const JointPositions& joints) {
  std::array<FootPlace, 2> out;
  for (const Side side : {Side::kLeft, Side::kRight})
    out[static_cast<size_t>(side)] = {joints[ankle(side)].head<2>(), joints[toe(side)].head<2>()};
  return out;
}

KineticsFrame frame_at(const LinkedBody& body, const LinkedState& state,
                       const JointPositions& joints, const std::optional<LoadShares>& shares,
                       const Vector3d& gravity) {
  KineticsFrame out;
  out.known = true;
  BodyLoad load;
  load.gravity = gravity;
  const BodyMomentum momentum = body_momentum(body.tree, state.q, state.u);
  out.com = momentum.com;
  out.kinetic_energy = momentum.kinetic_energy;
  out.potential_energy = -body.tree.mass() * gravity.dot(momentum.com);
  const Vector3d& root = joints[Joint::kPelvis];
  out.ground =
      missing_wrench(inverse_dynamics(body.tree, state.q, state.u, state.u_dot, load), root);
  if (shares) {
    const GroundLoads ground = shared_loads(out.ground, *shares, foot_places(joints), out.com);
    out.feet = ground.feet;
    out.unexplained_moment = ground.unexplained;
  }
  out.unexplained_force = (out.ground.force - sum_of(out.feet).force).norm();
  const auto motions = part_motions(body.tree, state.q, state.u, state.u_dot);
  load.forces = part_forces(body, motions, out.feet);
  const auto moments =
      inverse_dynamics(body.tree, state.q, state.u, state.u_dot, load).joint_moment;
  for (const Side side : {Side::kLeft, Side::kRight})
    out.legs[static_cast<size_t>(side)] = leg_loads(body, motions, moments, side);
  return out;
}

void add_totals(const Kinetics& all, const Span& span, double dt, double weight,
                KineticsTotals& totals) {
  for (size_t i = span.begin; i < span.end; ++i) {
    const KineticsFrame& frame = all.frames[i];
    for (size_t side = 0; side < 2; ++side) {
      const LegLoads& leg = frame.legs[side];
      for (const double power : {leg.hip_power, leg.knee_power, leg.ankle_power})
        (power > 0 ? totals.positive_work : totals.negative_work) += power * dt;
      totals.peak_load = std::max(totals.peak_load, frame.feet[side].force.z() / weight);
    }
    if (i > span.begin) totals.distance += (frame.com - all.frames[i - 1].com).head<2>().norm();
  }
}

}  // namespace

Kinetics kinetics_of(const Motion& motion, std::span<const FootContact> contacts,
                     const Subject& subject, const Vector3d& gravity,
                     const KineticsConfig& config) {
  Kinetics out;
  out.time = motion.time;
  out.frames.resize(motion.time.size());
  const double weight = subject.mass * gravity.norm();
  for (const Span& span : linkable_spans(motion)) {
    const double dt = sample_period(motion);
    const auto joints = smoothed(motion, span, 1 / dt, config.cutoff_hz);
    const LinkedBody body = linked_body(subject, joints);
    const std::vector<LinkedState> states = linked_states(body, joints, dt);
    for (size_t i = 0; i < states.size(); ++i) {
      const auto shares = load_shares(contacts, motion.time[span.begin + i]);
      out.frames[span.begin + i] = frame_at(body, states[i], joints[i], shares, gravity);
    }
    add_totals(out, span, dt, weight, out.totals);
  }
  out.totals.cost_of_transport = out.totals.distance > 0
                                     ? out.totals.positive_work / (weight * out.totals.distance)
                                     : std::numeric_limits<double>::quiet_NaN();
  return out;
}

}  // namespace kinetics
}  // namespace walktrack
