#include "gait/cycle.h"

#include <algorithm>
#include <functional>

#include "core/dense.h"
#include "gait/newton.h"
#include "gait/walker_units.h"

namespace walktrack {
inline namespace gait {
namespace {

constexpr double kDifference = 1e-5;    // with the map's error of 1e-12 the error is 1e-7
constexpr double kKneeStraight = 1e-6;  // rad; by hand, far above rounding

std::optional<CycleResidual> residual_of(const KneedModel& model, const GaitVector& gait,
                                         const GaitTarget& target) {
  const auto step = step_of(model, gait);
  if (!step) return std::nullopt;
  return cycle_residual(gait, *step, target);
}

}  // namespace

std::optional<WalkedStep> step_of(const KneedModel& model, const GaitVector& gait,
                                  double max_step) {
  const auto start = state_from(model, gait.tail<kSectionSize>());
  if (!start) return std::nullopt;
  auto step = walk_step(model, controls_from(gait.head<kControlSize>()), *start, max_step);
  if (step && step->knee_gap > kKneeStraight) return std::nullopt;
  return step;
}

CycleResidual cycle_residual(const GaitVector& gait, const WalkedStep& step,
                             const GaitTarget& target) {
  CycleResidual r;
  r << step.end - gait.tail<kSectionSize>(), step.measures.length - target.step_length,
      step.measures.period - target.step_length / target.speed;
  return r;
}

std::optional<CycleJacobian> cycle_jacobian(const KneedModel& model, const GaitVector& gait) {
  constexpr GaitTarget kAny{1, 1};
  CycleJacobian jacobian;
  for (int i = 0; i < kGaitSize; ++i) {
    const GaitVector shift = kDifference * GaitVector::Unit(i);
    const auto plus = residual_of(model, gait + shift, kAny);
    const auto minus = residual_of(model, gait - shift, kAny);
    if (!plus || !minus) return std::nullopt;
    jacobian.col(i) = (*plus - *minus) / (2 * kDifference);
  }
  return jacobian;
}

std::optional<GaitVector> find_cycle(const KneedModel& model, const GaitVector& guess,
                                     const GaitTarget& target) {
  return newton(
      guess, [&](const GaitVector& gait) { return residual_of(model, gait, target); },
      [&](const GaitVector& gait) { return cycle_jacobian(model, gait); });
}

KneedModel unit_model(const GaitTarget& target) { return kneed_model(unit_walker(target.slope)); }

std::optional<GaitVector> continue_cycle(const GaitVector& gait, const GaitTarget& from,
                                         const GaitTarget& to) {
  return continued(gait, from, to, [](const GaitVector& guess, const GaitTarget& target) {
    return find_cycle(unit_model(target), guess, target);
  });
}

SectionMatrix step_matrix(const CycleJacobian& jacobian) {
  return jacobian.block<kSectionSize, kSectionSize>(0, kControlSize) + SectionMatrix::Identity();
}

SectionVector multipliers(const SectionMatrix& matrix) { return eigenvalues(matrix).cwiseAbs(); }

}  // namespace gait
}  // namespace walktrack
