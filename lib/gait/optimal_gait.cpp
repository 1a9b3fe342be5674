#include "gait/optimal_gait.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlopt.hpp>

#include "core/dense.h"

namespace walktrack {
inline namespace gait {
namespace {

constexpr int kFree = kGaitSize - kResidualSize;
constexpr double kControlDifference = 1e-5;  // step of a control: the square root of the residual's
                                             // accuracy
constexpr double kOnCycle = 1e-7;            // residual at which the objective is evaluated
constexpr int kMaxChordSteps = 12;  // with one Jacobian, before it is computed again; by hand

double square(double x) { return x * x; }
double excess(double value, double limit, double scale) {
  return square(std::max(0.0, value - limit) / scale);
}

// The step matrix by one-sided differences, which take half the time; their error is far below the
// resolution of the stability term.
std::optional<SectionMatrix> cheap_step_matrix(const KneedModel& model, const GaitVector& gait,
                                               const WalkedStep& step) {
  SectionMatrix matrix;
  for (int i = 0; i < kSectionSize; ++i) {
    GaitVector shifted = gait;
    shifted[kControlSize + i] += kControlDifference;
    const auto other = step_of(model, shifted, kCoarseStep);
    if (!other) return std::nullopt;
    matrix.col(i) = (other->end - step.end) / kControlDifference;
  }
  return matrix;
}

// The objective on the tangent plane of the cycles at `origin`.
class TangentPlane {
 public:
  using Offset = Eigen::Matrix<double, kFree, 1>;

  TangentPlane(const KneedModel& model, const GaitTarget& target, const GaitObjective& objective,
               const GaitSearch& search, const GaitVector& origin, const CycleJacobian& jacobian)
      : model_(model), target_(target), objective_(objective), search_(search), origin_(origin) {
    basis_ = null_space(jacobian);
    inverse_ = pseudo_inverse(jacobian);
  }

  double cost(const Offset& offset) {
    const auto gait = on_cycle(origin_ + basis_ * offset);
    if (!gait) return kUnwalkable;
    const double cost = objective_value(model_, objective_, *gait) +
                        search_.attraction * (*gait - search_.centre).squaredNorm();
    if (cost < best_cost_) {
      best_cost_ = cost;
      best_ = *gait;
    }
    return cost;
  }

  double best_cost() const { return best_cost_; }
  const GaitVector& best() const { return best_; }

 private:
  std::optional<GaitVector> on_cycle(GaitVector gait) const {
    double last = std::numeric_limits<double>::infinity();
    for (int i = 0; i < kMaxChordSteps; ++i) {
      const auto step = step_of(model_, gait, kCoarseStep);
      if (!step) return std::nullopt;
      const CycleResidual residual = cycle_residual(gait, *step, target_);
      const double size = residual.norm();
      if (size < kOnCycle) return gait;
      if (i > 2 && size > 0.9 * last) return std::nullopt;
      last = size;
      gait -= inverse_ * residual;
    }
    return std::nullopt;
  }

  const KneedModel& model_;
  const GaitTarget& target_;
  const GaitObjective& objective_;
  const GaitSearch& search_;
  GaitVector origin_;
  Eigen::Matrix<double, kGaitSize, kFree> basis_;
  Eigen::Matrix<double, kGaitSize, kResidualSize> inverse_;
  GaitVector best_ = GaitVector::Zero();
  double best_cost_ = kUnwalkable;
};

double plane_cost(unsigned, const double* offset, double*, void* plane) {
  return static_cast<TangentPlane*>(plane)->cost(Eigen::Map<const TangentPlane::Offset>(offset));
}

void search_plane(TangentPlane& plane, const GaitSearch& search) {
  nlopt::opt bobyqa(nlopt::LN_BOBYQA, kFree);
  bobyqa.set_min_objective(plane_cost, &plane);
  bobyqa.set_lower_bounds(-search.radius);
  bobyqa.set_upper_bounds(search.radius);
  bobyqa.set_initial_step(search.radius / 4);
  bobyqa.set_maxeval(search.trials);
  bobyqa.set_xtol_abs(1e-4);
  bobyqa.set_ftol_rel(1e-3);
  std::vector<double> offset(kFree, 0.0);
  double least = 0;
  bobyqa.optimize(offset, least);
}

}  // namespace

double cost_of_transport(const GaitVector& gait, const WalkedStep& step) {
  const double impulse = gait[kControlSize - 1];
  return (0.5 * impulse * impulse + step.measures.positive_work) / step.measures.length;
}

double growth_per_step(const SectionMatrix& matrix) {
  SectionMatrix power = matrix;
  for (int i = 0; i < 3; ++i) power = (power * power).eval();
  return std::pow(power.norm(), 1.0 / 8);
}

double gait_cost(const GaitObjective& o, const GaitVector& gait, const WalkedStep& step) {
  const StepMeasures& m = step.measures;
  return cost_of_transport(gait, step) + o.torque * m.squared_torque / m.length +
         o.clearance * excess(-m.clearance, -o.least_clearance, o.least_clearance) +
         o.knee * (excess(-m.swing_flexion, -o.least_swing_flexion, o.knee_scale) +
                   excess(m.swing_flexion, o.most_swing_flexion, o.knee_scale) +
                   excess(m.stance_flexion, o.most_stance_flexion, o.knee_scale)) +
         o.lean * excess(m.largest_lean, o.most_lean, o.lean_scale) +
         o.normal * excess(-m.least_normal, -o.least_normal, o.normal_scale);
}

double objective_value(const KneedModel& model, const GaitObjective& objective,
                       const GaitVector& gait) {
  const auto step = step_of(model, gait, kCoarseStep);
  if (!step) return kUnwalkable;
  const auto matrix = cheap_step_matrix(model, gait, *step);
  if (!matrix) return kUnwalkable;
  const double growth = growth_per_step(*matrix) / objective.allowed_growth;
  return std::min(kUnwalkable, gait_cost(objective, gait, *step) +
                                   objective.stability * square(std::log(std::max(1.0, growth))));
}

GaitVector optimal_gait(const GaitVector& cycle, const GaitTarget& target,
                        const GaitObjective& objective, const GaitSearch& search) {
  const KneedModel model = unit_model(target);
  GaitVector best = cycle;
  double best_cost = kUnwalkable;
  for (int round = 0; round < search.rounds; ++round) {
    const auto jacobian = cycle_jacobian(model, best);
    if (!jacobian) break;
    TangentPlane plane(model, target, objective, search, best, *jacobian);
    best_cost = plane.cost(TangentPlane::Offset::Zero());
    search_plane(plane, search);
    const auto polished = find_cycle(model, plane.best(), target);
    if (plane.best_cost() >= best_cost || !polished) break;
    best = *polished;
    if (plane.best_cost() > best_cost * (1 - search.worthwhile)) break;
  }
  return best;
}

}  // namespace gait
}  // namespace walktrack
