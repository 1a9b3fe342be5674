#include "gait/step_map.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace walktrack {
inline namespace gait {
namespace {

constexpr double kLongestStep = 8;     // 2.5 s for an adult
constexpr double kMeasureStep = 0.03;  // 9 ms: torques change over some 50 ms

std::array<SpringDamper*, 4> joints(KneedControls& c) {
  return {&c.torso, &c.hip, &c.stance_knee, &c.swing_knee};
}

struct Sample {
  double power = 0, square = 0, normal = 0;
};

Sample sample(const KneedModel& model, const KneedControls& controls, const KneedState& s) {
  const Vector5 t = kneed_torques(controls, s.q, s.qd);
  // kneed_torques() sums the joints' torques over the parts on which they act; this separates them
  // again.
  const double torso = t[kTorso], stance_knee = t[kStanceShank], swing_knee = t[kSwingShank];
  const double hip = t[kSwingThigh] + swing_knee;
  const std::array<double, 4> torque{torso, hip, stance_knee, swing_knee};
  const std::array<double, 4> rate{
      s.qd[kTorso] - s.qd[kStanceThigh], s.qd[kSwingThigh] - s.qd[kStanceThigh],
      s.qd[kStanceShank] - s.qd[kStanceThigh], s.qd[kSwingShank] - s.qd[kSwingThigh]};
  Sample result;
  for (size_t i = 0; i < 4; ++i) {
    result.power += std::max(0.0, torque[i] * rate[i]);
    result.square += torque[i] * torque[i];
  }
  const KneedAcceleration a = kneed_accelerations(model, controls, Vector5::Zero(), s);
  result.normal = kneed_contact_force(model, s, a.qdd).y();
  return result;
}

}  // namespace

KneedControls controls_from(const ControlVector& v) {
  KneedControls c;
  int i = 0;
  for (SpringDamper* joint : joints(c)) {
    joint->stiffness = v[i] * v[i];
    joint->damping = v[i + 1] * v[i + 1];
    joint->rest = v[i + 2];
    i += 3;
  }
  c.toe_off_impulse = v[i];
  return c;
}

SectionVector section_of(const KneedState& s) {
  SectionVector v;
  v << s.q[kTorso], s.q[kStanceThigh], s.q[kSwingThigh], s.qd;
  return v;
}

std::optional<KneedState> state_from(const KneedModel& model, const SectionVector& v) {
  // Solves the height of the swing foot, hip_z - l_t cos q2 - (l_s - h) cos q4 - f sin q4 - R = 0;
  // of the two angles of the shank the one with a flexed knee is chosen.
  const KneedParameters& p = model.parameters;
  const double shank = p.shank_length - p.foot_up, forward = p.foot_forward;
  KneedState s;
  s.q << v[0], v[1], v[2], v[1], v[2];
  s.qd = v.tail<5>();
  const double needed = (p.thigh_length + shank) * std::cos(v[1]) + forward * std::sin(v[1]) -
                        p.thigh_length * std::cos(v[2]);
  const double reach = std::hypot(shank, forward);
  if (std::abs(needed) > reach) return std::nullopt;
  s.q[kSwingShank] = std::atan2(forward, shank) + std::acos(needed / reach);
  return s;
}

std::optional<WalkedStep> walk_step(const KneedModel& model, const KneedControls& controls,
                                    const KneedState& start, double max_step) {
  const KneedLimits limits{.max_step = max_step};
  KneedState state = start;
  WalkedStep step;
  StepMeasures& m = step.measures;
  Sample before = sample(model, controls, state);
  double passing_height = 1;
  m.least_normal = before.normal;
  while (m.period < kLongestStep) {
    m.swing_flexion = std::max(m.swing_flexion, state.q[kSwingShank] - state.q[kSwingThigh]);
    m.stance_flexion = std::max(m.stance_flexion, state.q[kStanceShank] - state.q[kStanceThigh]);
    m.largest_lean = std::max(m.largest_lean, std::abs(state.q[kTorso]));
    const SwingFoot foot = kneed_swing_foot(model, state);
    const KneedAdvance run =
        kneed_advance(model, controls, Vector5::Zero(), state, kMeasureStep, limits);
    if (run.event == KneedEvent::kFallen || run.event == KneedEvent::kDiverged) return std::nullopt;
    m.period += run.elapsed;
    const bool ended = run.event == KneedEvent::kTransfer;
    // The last piece is shorter than the others; its first sample represents it.
    const Sample after = ended ? before : sample(model, controls, state);
    m.positive_work += 0.5 * run.elapsed * (before.power + after.power);
    m.squared_torque += 0.5 * run.elapsed * (before.square + after.square);
    m.least_normal = std::min(m.least_normal, after.normal);
    before = after;
    if (!ended) {
      const SwingFoot moved = kneed_swing_foot(model, state);
      if (foot.lead < 0 && moved.lead >= 0)
        passing_height =
            foot.height - foot.lead * (moved.height - foot.height) / (moved.lead - foot.lead);
      continue;
    }
    m.length = state.contact_x - start.contact_x;
    m.clearance = std::min(run.clearance, passing_height);
    step.knee_gap = state.q[kStanceShank] - state.q[kStanceThigh];
    step.end = section_of(state);
    return step;
  }
  return std::nullopt;
}

}  // namespace gait
}  // namespace walktrack
