#include "walker/kneed/kneed_stops.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "walker/kneed/kneed_incidents.h"
#include "walker/kneed/kneed_points.h"

namespace walktrack {
inline namespace walker {
namespace {

struct StopSet {
  std::array<bool, 2> at{};         // knees that touch their stop
  Eigen::Matrix2d mobility;         // a' M^-1 a
  std::array<Vector5, 2> response;  // M^-1 a
};

Vector2 flexions(const Vector5& v) {
  return {v[kStanceShank] - v[kStanceThigh], v[kSwingShank] - v[kSwingThigh]};
}

StopSet stop_set(const KneedModel& model, const Vector5& q, std::array<bool, 2> at) {
  StopSet set;
  set.at = at;
  Matrix5 factor = kneed_mass_matrix(model, q);
  factorise(factor);
  set.response[0] = solve_factorised(factor, Vector5(0, -1, 0, 1, 0));
  set.response[1] = solve_factorised(factor, Vector5(0, 0, -1, 0, 1));
  set.mobility << flexions(set.response[0]), flexions(set.response[1]);
  return set;
}

Vector2 pushes(const StopSet& set, const Vector2& free, bool first, bool second) {
  const Eigen::Matrix2d& w = set.mobility;
  if (first && second) {
    const double determinant = w(0, 0) * w(1, 1) - w(0, 1) * w(1, 0);
    return Vector2(w(0, 1) * free[1] - w(1, 1) * free[0], w(1, 0) * free[0] - w(0, 0) * free[1]) /
           determinant;
  }
  return {first ? -free[0] / w(0, 0) : 0.0, second ? -free[1] / w(1, 1) : 0.0};
}

// The set of pushing stops; `tolerance` limits what counts as motion into a stop.
std::array<bool, 2> pushing_stops(const StopSet& set, const Vector2& free, double tolerance) {
  constexpr std::array<std::array<bool, 2>, 4> kSets{
      {{false, false}, {true, false}, {false, true}, {true, true}}};
  for (const auto& trial : kSets) {
    if ((trial[0] && !set.at[0]) || (trial[1] && !set.at[1])) continue;
    const Vector2 push = pushes(set, free, trial[0], trial[1]);
    const Vector2 gain = free + set.mobility * push;
    bool fits = true;
    for (int k = 0; k < 2; ++k)
      fits = fits && push[k] >= 0 && (!set.at[size_t(k)] || gain[k] >= -tolerance);
    if (fits) return trial;
  }
  return set.at;  // only rounding leads here; holding both is safe
}

void put_on_stops(KneedState& state, std::array<bool, 2> at) {
  if (at[0]) state.q[kStanceShank] = state.q[kStanceThigh];
  if (at[1]) state.q[kSwingShank] = state.q[kSwingThigh];
}

}  // namespace

std::array<double, 2> settle_knee_stops(const KneedModel& model, const KneedControls& controls,
                                        const Vector5& noise, KneedState& state) {
  const Vector2 angle = flexions(state.q);
  const std::array<bool, 2> at{state.stance_stop || angle[0] <= kAtStop,
                               state.swing_stop || angle[1] <= kAtStop};
  state.stance_stop = state.swing_stop = false;
  if (!at[0] && !at[1]) return {};
  put_on_stops(state, at);
  StopSet set = stop_set(model, state.q, at);

  const Vector2 rate = flexions(state.qd);
  const auto struck = pushing_stops(set, rate, kAtRest);
  const Vector2 impulse = pushes(set, rate, struck[0], struck[1]);
  for (int k = 0; k < 2; ++k) state.qd += impulse[k] * set.response[size_t(k)];

  const Vector2 rate_after = flexions(state.qd);
  for (size_t k = 0; k < 2; ++k)
    set.at[k] = at[k] && std::abs(rate_after[Eigen::Index(k)]) <= kAtRest;
  if (set.at[0]) state.qd[kStanceShank] = state.qd[kStanceThigh];
  if (set.at[1]) state.qd[kSwingShank] = state.qd[kSwingThigh];
  const Vector2 free = flexions(kneed_accelerations(model, controls, noise, state).qdd);
  const auto held = pushing_stops(set, free, 0);
  state.stance_stop = held[0];
  state.swing_stop = held[1];
  return {impulse[0], impulse[1]};
}

double kneed_step_size(const KneedModel& model, const KneedControls& controls,
                       const KneedState& state, double max_step) {
  // For row r of every spring, the sums of stiffness r' M^-1 r and damping r' M^-1 r are upper
  // bounds of the largest eigenvalues of M^-1 K and M^-1 D.
  constexpr std::array<std::array<double, 5>, 4> kRows{
      {{1, -1, 0, 0, 0}, {0, -1, 1, 0, 0}, {0, -1, 0, 1, 0}, {0, 0, -1, 0, 1}}};
  const std::array<const SpringDamper*, 4> springs{&controls.torso, &controls.hip,
                                                   &controls.stance_knee, &controls.swing_knee};
  Matrix5 factor = kneed_mass_matrix(model, state.q);
  factorise(factor);
  double square = 0, decay = 0;
  for (size_t i = 0; i < springs.size(); ++i) {
    const Vector5 row(kRows[i].data());
    const double mobility = row.dot(solve_factorised(factor, row));
    square += std::abs(springs[i]->stiffness) * mobility;
    decay += std::abs(springs[i]->damping) * mobility;
  }
  return std::min(max_step, kStepReach / std::max(std::sqrt(square), decay));
}

}  // namespace walker
}  // namespace walktrack
