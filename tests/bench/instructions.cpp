// Fixed work for callgrind: every group of functions runs between two marks, and callgrind writes
// its counts to a file with the group's name, for tests/bench/count_instructions.py.
#include <valgrind/callgrind.h>

#include <cmath>

#include "body/kinematics.h"
#include "observation/silhouette/silhouette.h"
#include "tests/bench/scenes.h"
#include "walker/kneed/kneed_batch.h"

namespace walktrack {
namespace {

// Keeps a result alive without adding to the count.
void keep(double value) { asm volatile("" : : "m"(value)); }

template <typename F>
void count(const char* group, size_t n, F&& work) {
  CALLGRIND_ZERO_STATS;
  CALLGRIND_START_INSTRUMENTATION;
  for (size_t i = 0; i < n; ++i) keep(work(i));
  CALLGRIND_STOP_INSTRUMENTATION;
  CALLGRIND_DUMP_STATS_AT(group);
}

void count_walkers() {
  const WalkerCrowd c = walker_crowd(64);
  count("dynamics", c.states.size(), [&](size_t i) {
    return kneed_accelerations(c.model, c.controls[i], c.torques[i], c.states[i]).qdd[0];
  });
  count("walking", c.states.size(), [&](size_t i) {
    KneedState state = c.states[i];
    kneed_advance(c.model, c.controls[i], c.torques[i], state, 0.1);
    return state.q[0];
  });
  const std::vector<double> durations(c.states.size(), 0.1);
  std::vector<KneedState> states = c.states;
  std::vector<KneedAdvance> runs(states.size());
  count("walking_batch", 1, [&](size_t) {
    kneed_advance_batch(c.model, c.controls, c.torques, durations, states, runs);
    return states.back().q[0];
  });
  count("gait_lookup", 16, [&](size_t i) {
    return gait_at(c.prior, c.parameters, 0.8 + 0.05 * static_cast<double>(i), 0.65).period;
  });
  Rng rng(1, Purpose::kTest);
  count("normals", 1000, [&](size_t) { return rng.normal(); });
}

void count_figures() {
  const FigureScene f = figure_scene(16);
  const auto parts = [&](size_t i) {
    return pose_parts(f.body, forward_kinematics(f.body, f.poses[i]));
  };
  count("posing", f.poses.size(), [&](size_t i) { return parts(i)[0].lower.x(); });
  count("projection", f.poses.size(),
        [&](size_t i) { return project_parts(f.camera, parts(i))[0].depth; });
  count("silhouette", f.poses.size(),
        [&](size_t i) { return silhouette_log_ratio(f.planes, f.capsules[i]); });
}

void count_particles() {
  ParticleScene scene = particle_scene(64);
  const MotionContext context = scene.context();
  std::vector<Rng> rngs;
  for (uint32_t i = 0; i < scene.particles.size(); ++i) rngs.emplace_back(1, Purpose::kMoves, 0, i);
  std::vector<Outcome> outcomes(scene.particles.size());
  count("propagate", 1, [&](size_t) {
    propagate(context, scene.particles, rngs, outcomes);
    return scene.particles.back().pose.tilt;
  });
  count("perturb", scene.particles.size(), [&](size_t i) {
    Rng rng(1, Purpose::kMoves, 0, static_cast<uint32_t>(i));
    perturb(context, 0.3, scene.particles[i], rng);
    return scene.particles[i].pose.tilt;
  });
}

}  // namespace
}  // namespace walktrack

int main() {
  walktrack::count_walkers();
  walktrack::count_figures();
  walktrack::count_particles();
}
