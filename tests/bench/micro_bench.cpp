// Times of the kernels and of their alternatives. Every benchmark reports `s_each`, the seconds for
// one item; tests/bench/ratios.py computes ratios.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdio>
#include <random>
#include <stdexcept>

#include "body/kinematics.h"
#include "observation/silhouette/silhouette.h"
#include "tests/bench/legs.h"
#include "tests/bench/limits.h"
#include "tests/bench/peers.h"
#include "tests/bench/scenes.h"
#include "walker/kneed/kneed_batch.h"

namespace walktrack {
namespace {

constexpr size_t kWalkers = 1024, kPoses = 64;
constexpr double kFrame = 1.0 / 30;  // s

const WalkerCrowd& crowd() {
  static const WalkerCrowd crowd = walker_crowd(kWalkers);
  return crowd;
}

const FigureScene& figures() {
  static const FigureScene scene = figure_scene(kPoses);
  return scene;
}

// Calls work(i) for every one of n items.
template <typename F>
void each(benchmark::State& state, size_t n, F&& work) {
  for (auto _ : state)
    for (size_t i = 0; i < n; ++i) benchmark::DoNotOptimize(work(i));
  set_items(state, static_cast<double>(n));
}

void dynamics_scalar(benchmark::State& state) {
  const WalkerCrowd& c = crowd();
  each(state, kWalkers, [&](size_t i) {
    return kneed_accelerations(c.model, c.controls[i], c.torques[i], c.states[i]);
  });
}
BENCHMARK(dynamics_scalar);

void dynamics_tmt_eigen(benchmark::State& state) {
  const WalkerCrowd& c = crowd();
  const TmtWalker tmt(c.model);
  each(state, kWalkers, [&](size_t i) { return tmt.accelerations(c.controls[i], c.states[i]); });
}
BENCHMARK(dynamics_tmt_eigen);

#if WALKTRACK_HAS_MUJOCO
void dynamics_mujoco(benchmark::State& state) {
  const WalkerCrowd& c = crowd();
  MujocoBiped biped;
  each(state, kWalkers, [&](size_t i) { return biped.evaluate(c.states[i].q, c.states[i].qd); });
}
BENCHMARK(dynamics_mujoco);
#endif

limits::Linkage limit_linkage(const KneedModel& model) {
  limits::Linkage linkage{};
  for (int j = 0; j < 5; ++j) {
    linkage.along[j] = model.along_moment[j];
    linkage.across[j] = model.across_moment[j];
    for (int k = 0; k < 5; ++k) {
      linkage.couple[j][k] = model.couple(j, k);
      linkage.skew[j][k] = model.skew(j, k);
    }
  }
  linkage.radius = model.parameters.foot_radius;
  linkage.total_mass = model.total_mass;
  linkage.gravity_x = model.gravity.x();
  linkage.gravity_z = model.gravity.y();
  return linkage;
}

// [coordinate][walker]
std::vector<double> columns(const std::vector<KneedState>& states, Vector5 KneedState::*field) {
  std::vector<double> out;
  for (int k = 0; k < 5; ++k)
    for (const KneedState& s : states) out.push_back((s.*field)[k]);
  return out;
}

void dynamics_soa_limit(benchmark::State& state) {
  const WalkerCrowd& c = crowd();
  const limits::Linkage linkage = limit_linkage(c.model);
  const std::vector<double> q = columns(c.states, &KneedState::q);
  const std::vector<double> qd = columns(c.states, &KneedState::qd);
  std::vector<double> qdd(5 * kWalkers);
  for (auto _ : state) {
    limits::accelerations(linkage, kWalkers, q.data(), qd.data(), qdd.data());
    benchmark::DoNotOptimize(qdd.data());
    benchmark::ClobberMemory();
  }
  set_items(state, kWalkers);
}
BENCHMARK(dynamics_soa_limit);

// One particle, one frame, with its torques' noise drawn; RK4 at 2 ms.
void frame_scalar(benchmark::State& state) {
  const WalkerCrowd& c = crowd();
  const KneedLimits limits{.max_step = 0.002};
  each(state, kWalkers, [&](size_t i) {
    Rng rng(1, Purpose::kTorque, 0, static_cast<uint32_t>(i));
    const Vector5 torque = draw_torques(rng, c.gait.units, {}, kFrame);
    KneedState walker = c.states[i];
    return kneed_advance(c.model, c.controls[i], torque, walker, kFrame, limits);
  });
}
BENCHMARK(frame_scalar);

std::vector<Vector5> drawn_torques(const WalkerCrowd& c) {
  std::vector<Vector5> torques(kWalkers);
  for (size_t i = 0; i < kWalkers; ++i) {
    Rng rng(1, Purpose::kTorque, 0, static_cast<uint32_t>(i));
    torques[i] = draw_torques(rng, c.gait.units, {}, kFrame);
  }
  return torques;
}

// The same for all at once.
void frame_batch(benchmark::State& state) {
  const WalkerCrowd& c = crowd();
  const KneedLimits limits{.max_step = 0.002};
  const std::vector<double> durations(kWalkers, kFrame);
  std::vector<KneedState> walkers;
  std::vector<KneedAdvance> runs(kWalkers);
  for (auto _ : state) {
    walkers = c.states;
    kneed_advance_batch(c.model, c.controls, drawn_torques(c), durations, walkers, runs, limits);
    benchmark::ClobberMemory();
  }
  set_items(state, kWalkers);
}
BENCHMARK(frame_batch);

// One evaluation of the dynamics inside the batch kernel: four for each of 17 sub-steps, one at the
// beginning. The walkers have no event; loading and storing of states is included.
void dynamics_batch(benchmark::State& state) {
  const WalkerCrowd& c = crowd();
  const KneedLimits limits{.max_step = 0.002};
  std::vector<size_t> quiet;
  for (size_t i = 0; i < kWalkers; ++i) {
    KneedState s = c.states[i], half = s;
    kneed_advance(c.model, c.controls[i], c.torques[i], half, 0.5 * kFrame, limits);
    const auto run = kneed_advance(c.model, c.controls[i], c.torques[i], s, kFrame, limits);
    const bool same = s.stance_stop == c.states[i].stance_stop &&
                      s.swing_stop == c.states[i].swing_stop && half.stance_stop == s.stance_stop &&
                      half.swing_stop == s.swing_stop;
    if (same && run.event == KneedEvent::kNone) quiet.push_back(i);
  }
  quiet.resize(512);
  std::vector<KneedControls> controls;
  std::vector<Vector5> torques;
  std::vector<KneedState> starts, walkers;
  for (const size_t i : quiet) {
    controls.push_back(c.controls[i]);
    torques.push_back(c.torques[i]);
    starts.push_back(c.states[i]);
  }
  const std::vector<double> durations(quiet.size(), kFrame);
  std::vector<KneedAdvance> runs(quiet.size());
  for (auto _ : state) {
    walkers = starts;
    kneed_advance_batch(c.model, controls, torques, durations, walkers, runs, limits);
    benchmark::ClobberMemory();
  }
  set_items(state, static_cast<double>(quiet.size()) * (4 * 17 + 1));
}
BENCHMARK(dynamics_batch);

void normal_ours(benchmark::State& state) {
  Rng rng(1, Purpose::kTest);
  each(state, 1000, [&](size_t) { return rng.normal(); });
}
BENCHMARK(normal_ours);

void normal_std(benchmark::State& state) {
  std::mt19937_64 engine(1);
  std::normal_distribution<double> normal;
  each(state, 1000, [&](size_t) { return normal(engine); });
}
BENCHMARK(normal_std);

void silhouette_log_ratio(benchmark::State& state) {
  const FigureScene& f = figures();
  each(state, kPoses,
       [&](size_t i) { return walktrack::silhouette_log_ratio(f.planes, f.capsules[i]); });
  state.counters["rows"] = f.mean_rows;
}
BENCHMARK(silhouette_log_ratio);

std::vector<limits::TaperedPart> limit_parts(const CapsuleList& capsules) {
  const auto single = [](double value) { return static_cast<float>(value); };
  std::vector<limits::TaperedPart> parts;
  for (const auto& [a, b, depth, appearance, part] : capsules)
    parts.push_back({{single(a.centre.x()), single(b.centre.x())},
                     {single(a.centre.y()), single(b.centre.y())},
                     {single(a.radius), single(b.radius)}});
  return parts;
}

limits::PrefixPlane limit_plane(const LogRatioPlanes& planes) {
  const size_t pitch = static_cast<size_t>(planes.count) * planes.stride();
  return {planes.area.width(), planes.area.height(), planes.prefix.data(), pitch};
}

void silhouette_scanline_limit(benchmark::State& state) {
  const FigureScene& f = figures();
  std::vector<std::vector<limits::TaperedPart>> bodies;
  for (const CapsuleList& list : f.capsules) bodies.push_back(limit_parts(list));
  const limits::PrefixPlane plane = limit_plane(f.planes);
  each(state, kPoses, [&](size_t i) { return limits::silhouette(plane, bodies[i]); });
}
BENCHMARK(silhouette_scanline_limit);

void silhouette_per_pixel(benchmark::State& state) {
  const FigureScene& f = figures();
  each(state, kPoses, [&](size_t i) { return per_pixel_silhouette(f.planes, f.capsules[i]); });
}
BENCHMARK(silhouette_per_pixel);

// A pose's parts in the world and in the image.
void pose_to_capsules(benchmark::State& state) {
  const FigureScene& f = figures();
  each(state, kPoses, [&](size_t i) {
    return project_parts(f.camera, pose_parts(f.body, forward_kinematics(f.body, f.poses[i])));
  });
}
BENCHMARK(pose_to_capsules);

void tracker_propagate(benchmark::State& state) {
  static const ParticleScene scene = particle_scene(kPoses);
  const MotionContext context = scene.context();
  std::vector<Rng> rngs;
  for (uint32_t i = 0; i < kPoses; ++i) rngs.emplace_back(1, Purpose::kMoves, 0, i);
  std::vector<Outcome> outcomes(kPoses);
  for (auto _ : state) {
    std::vector<WalkerParticle> particles = scene.particles;
    propagate(context, particles, rngs, outcomes);
    benchmark::DoNotOptimize(particles.data());
  }
  set_items(state, kPoses);
}
BENCHMARK(tracker_propagate);

void gait_lookup(benchmark::State& state) {
  const WalkerCrowd& c = crowd();
  each(state, 100, [&](size_t i) {
    return gait_at(c.prior, c.parameters, 0.8 + 0.01 * static_cast<double>(i), 0.65);
  });
}
BENCHMARK(gait_lookup);

// Alternatives and limits must compute the same, or their times mean nothing.
void check_dynamics() {
  const WalkerCrowd& c = crowd();
  const TmtWalker tmt(c.model);
  const std::vector<double> q = columns(c.states, &KneedState::q);
  const std::vector<double> qd = columns(c.states, &KneedState::qd);
  std::vector<double> qdd(5 * kWalkers);
  limits::accelerations(limit_linkage(c.model), kWalkers, q.data(), qd.data(), qdd.data());
  for (size_t i = 0; i < kWalkers; ++i) {
    KneedState free = c.states[i];
    free.stance_stop = free.swing_stop = false;
    const auto ours = [&](const KneedControls& controls) {
      return kneed_accelerations(c.model, controls, Vector5::Zero(), free).qdd;
    };
    constexpr double kRounding = 1e-7;  // rad/s^2 of some hundred
    const Vector5 passive = ours({});
    for (int k = 0; k < 5; ++k)
      if (!(std::abs(qdd[static_cast<size_t>(k) * kWalkers + i] - passive[k]) < kRounding))
        throw std::runtime_error("the limit of forward dynamics computes something else");
    if (!((tmt.accelerations(c.controls[i], free) - ours(c.controls[i])).norm() < kRounding))
      throw std::runtime_error("TMT computes something else");
  }
}

void check_silhouettes() {
  const FigureScene& f = figures();
  LogRatioPlanes ones;
  resize(ones, f.planes.area, 1);
  const std::vector<float> row(static_cast<size_t>(ones.area.width()), 1);
  for (int y = ones.area.y0; y < ones.area.y1; ++y) set_row(ones, 0, y, row, 1);
  for (const CapsuleList& list : f.capsules) {
    const double pixels = walktrack::silhouette_log_ratio(ones, list);
    if (per_pixel_silhouette(ones, list) != pixels)
      throw std::runtime_error("the sum over pixels is another");
    const auto limit =
        static_cast<double>(limits::silhouette(limit_plane(ones), limit_parts(list)));
    constexpr double kSinglePrecision = 1e-3;  // some pixels at borders differ
    if (!(std::abs(limit / LogRatioPlanes::kNat / pixels - 1) < kSinglePrecision))
      throw std::runtime_error("the limit of a silhouette computes something else");
  }
}

}  // namespace
}  // namespace walktrack

int main(int argc, char** argv) try {
  walktrack::check_dynamics();
  walktrack::check_legs();
  walktrack::check_silhouettes();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "micro_bench: %s\n", error.what());
  return 1;
}
