#include "tests/bench/legs.h"

#include <cmath>
#include <stdexcept>
#include <vector>

#include "tests/bench/limits.h"
#include "walker/straight/straight_batch.h"

namespace walktrack {
namespace {

constexpr size_t kWalkers = 1024;
constexpr int kSubSteps = 17;
constexpr double kFrame = 0.108;  // 1/30 s for an adult, in units L = M = g = 1
constexpr double kStep = kFrame / kSubSteps * (1 + 1e-9);

// Walkers at all moments of the steps of a published cycle (configs/models/kuo_level_spring.yaml),
// none of which ends within a frame.
struct LegsCrowd {
  StraightModel model = straight_model({.gravity = 1});
  std::vector<StraightControls> controls;
  std::vector<Vector2> noise;
  std::vector<StraightState> states;
};

LegsCrowd legs_crowd() {
  constexpr double kPeriod = 1.5744242;
  LegsCrowd c;
  for (size_t i = 0; i < kWalkers; ++i) {
    const StraightControls controls{0.1, 0.1};
    StraightState s;
    s.q = {-0.335708232, 0.335708232};
    s.qd = {0.512001304, 0.393117244};
    const double phase = static_cast<double>(i) / kWalkers;
    straight_advance(c.model, controls, Vector2::Zero(), s, phase * (kPeriod - 1.1 * kFrame));
    c.controls.push_back(controls);
    c.noise.push_back({0.001 * phase, 0});
    c.states.push_back(s);
  }
  return c;
}

const LegsCrowd& crowd() {
  static const LegsCrowd crowd = legs_crowd();
  return crowd;
}

limits::Legs limit_legs(const StraightModel& m) {
  return {m.stance_couple, m.cross_couple, m.swing_couple, m.stance_moment, m.swing_moment,
          m.radius,        m.mass,         m.gravity_x,    m.gravity_z};
}

// [leg][walker]
std::vector<double> columns(Vector2 StraightState::*field) {
  std::vector<double> out;
  for (int k = 0; k < 2; ++k)
    for (const StraightState& s : crowd().states) out.push_back((s.*field)[k]);
  return out;
}

// Four evaluations for each sub-step of a frame and one at the beginning, including the search for
// strikes, loading and storing.
void legs_batch(benchmark::State& state) {
  const LegsCrowd& c = crowd();
  const std::vector<double> durations(kWalkers, kFrame);
  std::vector<StraightState> walkers;
  std::vector<StraightAdvance> runs(kWalkers);
  for (auto _ : state) {
    walkers = c.states;
    straight_advance_batch(c.model, c.controls, c.noise, durations, walkers, runs, kStep);
    benchmark::ClobberMemory();
  }
  set_items(state, kWalkers * (4 * kSubSteps + 1));
}
BENCHMARK(legs_batch);

void legs_scalar(benchmark::State& state) {
  const LegsCrowd& c = crowd();
  for (auto _ : state)
    for (size_t i = 0; i < kWalkers; ++i)
      benchmark::DoNotOptimize(
          straight_accelerations(c.model, c.controls[i].stiffness, c.noise[i], c.states[i]));
  set_items(state, kWalkers);
}
BENCHMARK(legs_scalar);

void legs_soa_limit(benchmark::State& state) {
  const limits::Legs legs = limit_legs(crowd().model);
  const std::vector<double> q = columns(&StraightState::q), qd = columns(&StraightState::qd);
  std::vector<double> qdd(2 * kWalkers);
  for (auto _ : state) {
    limits::accelerations(legs, kWalkers, q.data(), qd.data(), qdd.data());
    benchmark::DoNotOptimize(qdd.data());
    benchmark::ClobberMemory();
  }
  set_items(state, kWalkers);
}
BENCHMARK(legs_soa_limit);

}  // namespace

void check_legs() {
  const LegsCrowd& c = crowd();
  const std::vector<double> q = columns(&StraightState::q), qd = columns(&StraightState::qd);
  std::vector<double> qdd(2 * kWalkers);
  limits::accelerations(limit_legs(c.model), kWalkers, q.data(), qd.data(), qdd.data());
  for (size_t i = 0; i < kWalkers; ++i) {
    const Vector2 ours = straight_accelerations(c.model, 0, Vector2::Zero(), c.states[i]);
    constexpr double kRounding = 1e-12;  // of about 1
    if (!((ours - Vector2(qdd[i], qdd[kWalkers + i])).norm() < kRounding))
      throw std::runtime_error("the limit of two legs computes something else");
  }
}

}  // namespace walktrack
