#include "gait/cycle.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>

#include "gait/walker_units.h"

namespace walktrack {
namespace {

constexpr double kDifference = 1e-5;    // the map's error of 1e-12 then costs 1e-7
constexpr double kKneeStraight = 1e-6;  // rad
constexpr double kConverged = 1e-9;
constexpr int kMaxIterations = 15;
constexpr int kMaxHalvings = 7;

struct Trial {
  GaitVector gait;
  CycleResidual residual;
};

std::optional<Trial> trial_of(const KneedModel& model, const GaitVector& gait,
                              const GaitTarget& target) {
  const auto step = step_of(model, gait);
  if (!step) return std::nullopt;
  return Trial{gait, cycle_residual(gait, *step, target)};
}

// The first of the halved Newton steps that lowers the residual.
std::optional<Trial> improved(const KneedModel& model, const Trial& from, const GaitVector& step,
                              const GaitTarget& target) {
  double share = 1;
  for (int i = 0; i < kMaxHalvings; ++i, share /= 2) {
    auto next = trial_of(model, from.gait + share * step, target);
    if (next && next->residual.norm() < from.residual.norm()) return next;
  }
  return std::nullopt;
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
    const auto plus = trial_of(model, gait + shift, kAny);
    const auto minus = trial_of(model, gait - shift, kAny);
    if (!plus || !minus) return std::nullopt;
    jacobian.col(i) = (plus->residual - minus->residual) / (2 * kDifference);
  }
  return jacobian;
}

std::optional<GaitVector> find_cycle(const KneedModel& model, const GaitVector& guess,
                                     const GaitTarget& target) {
  auto trial = trial_of(model, guess, target);
  for (int i = 0; trial && i < kMaxIterations; ++i) {
    if (trial->residual.norm() < kConverged) return trial->gait;
    const auto jacobian = cycle_jacobian(model, trial->gait);
    if (!jacobian) return std::nullopt;
    const GaitVector step = jacobian->completeOrthogonalDecomposition().solve(-trial->residual);
    trial = improved(model, *trial, step, target);
  }
  return std::nullopt;
}

KneedModel unit_model(const GaitTarget& target) { return kneed_model(unit_walker(target.slope)); }

std::optional<GaitVector> continue_cycle(const GaitVector& gait, const GaitTarget& from,
                                         const GaitTarget& to) {
  constexpr double kSmallestShare = 1.0 / 64;
  GaitVector at = gait;
  double done = 0, share = 1;
  while (done < 1) {
    const double next = std::min(1.0, done + share);
    const auto between = [&](double a, double b) { return a + next * (b - a); };
    const GaitTarget target{between(from.speed, to.speed),
                            between(from.step_length, to.step_length),
                            between(from.slope, to.slope)};
    if (const auto found = find_cycle(unit_model(target), at, target)) {
      at = *found;
      done = next;
    } else if ((share /= 2) < kSmallestShare) {
      return std::nullopt;
    }
  }
  return at;
}

SectionMatrix step_matrix(const CycleJacobian& jacobian) {
  return jacobian.block<kSectionSize, kSectionSize>(0, kControlSize) + SectionMatrix::Identity();
}

SectionVector multipliers(const SectionMatrix& matrix) {
  SectionVector values = matrix.eigenvalues().cwiseAbs();
  std::sort(values.data(), values.data() + kSectionSize, std::greater<>());
  return values;
}

}  // namespace walktrack
