#include "gait/straight_cycle.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>

#include "core/dense.h"
#include "gait/newton.h"

namespace walktrack {
inline namespace gait {
namespace {

constexpr double kLongestStraightStep = 8;    // 2.5 s for an adult
constexpr double kSubStep = 0.005;            // 1.5 ms for an adult: cycles are exact to 1e-9
constexpr double kForceInterval = 0.02;       // 6 ms: ground forces change over some 100 ms
constexpr double kStraightDifference = 1e-5;  // with the map's error of 1e-12 the error is 1e-7

// (section, advance, period) after a step of each gait.
template <size_t kCount>
std::optional<std::array<StraightGaitVector, kCount>> ends_of(
    const StraightModel& model, const std::array<StraightGaitVector, kCount>& gaits) {
  std::array<StraightControls, kCount> controls;
  std::array<StraightState, kCount> states;
  std::array<Vector2, kCount> noise;
  std::array<double, kCount> durations;
  std::array<StraightAdvance, kCount> runs;
  noise.fill(Vector2::Zero());
  durations.fill(kLongestStraightStep);
  for (size_t i = 0; i < kCount; ++i) {
    controls[i] = straight_controls_from(gaits[i]);
    states[i] = straight_state_from(gaits[i].template tail<kStraightSectionSize>());
  }
  straight_advance_batch(model, controls, noise, durations, states, runs, kSubStep);
  std::array<StraightGaitVector, kCount> ends;
  for (size_t i = 0; i < kCount; ++i) {
    if (runs[i].event != KneedEvent::kTransfer) return std::nullopt;
    const double begin = -model.radius * gaits[i][kStraightControlSize];  // the leg at -angle
    const double advance = states[i].contact_x + model.radius * states[i].q[0] - begin;
    ends[i] << section_of(states[i]), advance, runs[i].elapsed;
  }
  return ends;
}

StraightGaitVector wanted(const StraightGaitVector& gait, const GaitTarget& target) {
  StraightGaitVector v;
  v << gait.tail<kStraightSectionSize>(), target.step_length, target.step_length / target.speed;
  return v;
}

}  // namespace

StraightModel straight_unit_model(double slope) {
  return straight_model({.gravity = 1, .slope = slope});
}

StraightControls straight_controls_from(const StraightGaitVector& gait) {
  return {gait[0], gait[1]};
}

StraightState straight_state_from(const StraightSection& section) {
  StraightState state;
  state.q = {-section[0], section[0]};
  state.qd = section.tail<2>();
  return state;
}

StraightSection section_of(const StraightState& state) {
  return {0.5 * (state.q[1] - state.q[0]), state.qd[0], state.qd[1]};
}

std::optional<StraightStep> straight_step(const StraightModel& model,
                                          const StraightGaitVector& gait) {
  const StraightControls controls = straight_controls_from(gait);
  const Vector2 calm = Vector2::Zero();
  StraightState state = straight_state_from(gait.tail<kStraightSectionSize>());
  StraightStep step;
  step.least_normal = model.mass;  // times g = 1
  const double begin = model.radius * state.q[0];
  while (step.period < kLongestStraightStep) {
    const Vector2 qdd = straight_accelerations(model, controls.stiffness, calm, state);
    step.least_normal = std::min(step.least_normal, straight_contact_force(model, state, qdd).y());
    const StraightAdvance run =
        straight_advance(model, controls, calm, state, kForceInterval, kSubStep);
    step.period += run.elapsed;
    if (run.event == KneedEvent::kNone) continue;
    if (run.event != KneedEvent::kTransfer) return std::nullopt;
    step.end = section_of(state);
    step.advance = state.contact_x + model.radius * state.q[0] - begin;
    step.toe_off_work = run.toe_off_work;
    step.old_foot_lifts = run.old_foot_lifts;
    return step;
  }
  return std::nullopt;
}

StraightGaitVector cycle_residual(const StraightGaitVector& gait, const StraightStep& step,
                                  const GaitTarget& target) {
  StraightGaitVector end;
  end << step.end, step.advance, step.period;
  return end - wanted(gait, target);
}

std::optional<StraightJacobian> cycle_jacobian(const StraightModel& model,
                                               const StraightGaitVector& gait) {
  std::array<StraightGaitVector, 2 * kStraightGaitSize> gaits;
  for (size_t i = 0; i < kStraightGaitSize; ++i) {
    const StraightGaitVector shift =
        kStraightDifference * StraightGaitVector::Unit(static_cast<Eigen::Index>(i));
    gaits[2 * i] = gait + shift;
    gaits[2 * i + 1] = gait - shift;
  }
  const auto ends = ends_of(model, gaits);
  if (!ends) return std::nullopt;
  StraightJacobian jacobian;
  for (size_t i = 0; i < kStraightGaitSize; ++i)
    jacobian.col(static_cast<Eigen::Index>(i)) =
        ((*ends)[2 * i] - (*ends)[2 * i + 1]) / (2 * kStraightDifference);
  jacobian.block<kStraightSectionSize, kStraightSectionSize>(0, kStraightControlSize) -=
      StraightStepMatrix::Identity();
  return jacobian;
}

StraightStepMatrix step_matrix(const StraightJacobian& jacobian) {
  return jacobian.block<kStraightSectionSize, kStraightSectionSize>(0, kStraightControlSize) +
         StraightStepMatrix::Identity();
}

double largest_multiplier(const StraightJacobian& jacobian) {
  return std::abs(eigenvalues(step_matrix(jacobian))(0));
}

std::optional<StraightGaitVector> find_straight_cycle(const StraightGaitVector& guess,
                                                      const GaitTarget& target) {
  const StraightModel model = straight_unit_model(target.slope);
  const auto residual = [&](const StraightGaitVector& gait) -> std::optional<StraightGaitVector> {
    const auto ends = ends_of(model, std::array{gait});
    if (!ends) return std::nullopt;
    return ends->front() - wanted(gait, target);
  };
  const auto jacobian = [&](const StraightGaitVector& gait) { return cycle_jacobian(model, gait); };
  auto found = newton(guess, residual, jacobian);
  if (!found) return std::nullopt;
  const auto at_cycle = jacobian(*found);
  if (!at_cycle || at_cycle->determinant() >= 0) return std::nullopt;
  return found;
}

}  // namespace gait
}  // namespace walktrack
