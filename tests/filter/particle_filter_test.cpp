#include "filter/particle_filter.h"

#include <array>
#include <atomic>
#include <cmath>
#include <functional>
#include <vector>

#include <gtest/gtest.h>

#include "core/conventions.h"
#include "core/rng.h"

namespace walktrack {
namespace {

// The model with a known solution: x' = a x + q noise, y = x + r noise. A state consists of the
// prediction and the standardised noise on top, so that a move is reversible with respect to the
// prior (preconditioned Crank-Nicolson).
struct LinearState {
  double predicted = 0, noise = 0;
};
constexpr double kA = 0.9, kQ = 0.5;
double value(const LinearState& s) { return s.predicted + kQ * s.noise; }

struct Kalman {
  double mean = 0, variance = 0, log_evidence = 0;
  void step(double y, double r) {
    mean *= kA;
    variance = kA * kA * variance + kQ * kQ;
    const double s = variance + r * r, innovation = y - mean;
    log_evidence = -0.5 * (std::log(2 * kPi * s) + innovation * innovation / s);
    mean += variance / s * innovation;
    variance -= variance * variance / s;
  }
};

struct LinearRun {
  std::vector<double> mean, variance, log_evidence, exact_mean, exact_variance, exact_evidence;
  std::vector<LinearState> states;
};

// The log-likelihood of one number, split as if parts of it came from different cameras.
struct InStages {
  std::function<double(const LinearState&)> whole;
  std::array<std::atomic<int>, kMaxStages>* asked;

  int stages() const { return kMaxStages; }
  auto operator()(const LinearState& state) const {
    return [this, value = whole(state)](int stage) {
      constexpr std::array<double, kMaxStages> kShares{0.6, 0.4};
      ++(*asked)[static_cast<size_t>(stage)];
      return kShares[static_cast<size_t>(stage)] * value;
    };
  }
};

LinearRun run_linear(FilterConfig config, double r, int frames, int threads, uint64_t seed,
                     std::array<std::atomic<int>, kMaxStages>* asked = nullptr) {
  ParticleFilter<LinearState> filter(config, seed, threads);
  filter.start(std::vector<LinearState>(static_cast<size_t>(config.particles)));
  Kalman kalman;
  Rng truth(seed, Purpose::kTest);
  double x = 0;
  LinearRun run;
  for (int t = 0; t < frames; ++t) {
    x = kA * x + kQ * truth.normal();
    const double y = x + r * truth.normal();
    const auto frame = static_cast<uint32_t>(t);
    const auto propagate = [&](LinearState& s, uint32_t i) {
      s = {kA * value(s), Rng(seed, Purpose::kTorque, frame, i).normal()};
      return true;
    };
    const auto log_likelihood = [&](const LinearState& s) {
      const double z = (y - value(s)) / r;
      return -0.5 * z * z - std::log(r * std::sqrt(2 * kPi));
    };
    const auto move = [](LinearState& s, double scale, Rng& rng) {
      s.noise = std::sqrt(1 - scale * scale) * s.noise + scale * rng.normal();
    };
    const FilterReport report =
        asked ? filter.step(frame, propagate, InStages{log_likelihood, asked}, move)
              : filter.step(frame, propagate, log_likelihood, move);
    kalman.step(y, r);
    const auto& set = filter.particles();
    const std::vector<double> p = normalised_weights(set.log_weights);
    double mean = 0, square = 0;
    for (size_t i = 0; i < p.size(); ++i) mean += p[i] * value(set.states[i]);
    for (size_t i = 0; i < p.size(); ++i) square += p[i] * std::pow(value(set.states[i]) - mean, 2);
    run.mean.push_back(mean);
    run.variance.push_back(square);
    run.log_evidence.push_back(report.log_evidence);
    run.exact_mean.push_back(kalman.mean);
    run.exact_variance.push_back(kalman.variance);
    run.exact_evidence.push_back(kalman.log_evidence);
  }
  run.states = filter.particles().states;
  return run;
}

// Both the plain and the tempered filter must agree with the exact posterior. The variance of a
// self-normalised estimate is below kSpread * posterior variance / N for these likelihoods
// (effective sample sizes above N / kSpread).
void expect_kalman(const FilterConfig& config, double r, double spread,
                   std::array<std::atomic<int>, kMaxStages>* asked = nullptr) {
  const LinearRun run = run_linear(config, r, 60, 1, 11, asked);
  double z_mean = 0, z_evidence = 0;
  for (size_t t = 0; t < run.mean.size(); ++t) {
    const double sigma = std::sqrt(spread * run.exact_variance[t] / config.particles);
    EXPECT_NEAR(run.mean[t], run.exact_mean[t], 5 * sigma) << t;
    EXPECT_NEAR(run.variance[t] / run.exact_variance[t], 1,
                5 * std::sqrt(2 * spread / config.particles));
    z_mean += std::pow((run.mean[t] - run.exact_mean[t]) / sigma, 2) / double(run.mean.size());
    z_evidence += (run.log_evidence[t] - run.exact_evidence[t]) / double(run.mean.size());
  }
  EXPECT_GT(z_mean, 0.01);  // the tolerance is small enough
  EXPECT_NEAR(z_evidence, 0, 5 * std::sqrt(spread / config.particles / 60.0));
}

TEST(ParticleFilter, PlainFilterAgreesWithTheKalmanFilter) {
  expect_kalman({.particles = 20000, .max_layers = 1, .moves = 0}, 0.5, 4);
}

TEST(ParticleFilter, TemperedFilterAgreesWithTheKalmanFilterOnASharpLikelihood) {
  expect_kalman({.particles = 20000, .max_layers = 12, .moves = 3}, 0.02, 30);
}

TEST(ParticleFilter, StagesLeaveThePosteriorAsItIsAndTheSecondIsAskedLess) {
  std::array<std::atomic<int>, kMaxStages> asked{};
  expect_kalman({.particles = 20000, .max_layers = 12, .moves = 3}, 0.02, 30, &asked);
  EXPECT_LT(asked[1], 0.9 * asked[0]);
}

TEST(ParticleFilter, BitIdenticalForAnyThreadCount) {
  const FilterConfig config{.particles = 500, .moves = 2};
  const LinearRun one = run_linear(config, 0.05, 20, 1, 5);
  for (const int threads : {2, 8}) {
    const LinearRun many = run_linear(config, 0.05, 20, threads, 5);
    EXPECT_EQ(many.mean, one.mean);
    EXPECT_EQ(many.log_evidence, one.log_evidence);
  }
  EXPECT_NE(run_linear(config, 0.05, 20, 1, 6).mean, one.mean);
}

TEST(ParticleFilter, GroupsOfAnySizeTakeEveryStateOnceWithItsNumber) {
  constexpr size_t kStates = 100;
  const auto move = [](LinearState&, double, Rng&) {};
  for (const size_t group : {1, 7, 64, 1000}) {
    ParticleFilter<LinearState> filter({.particles = int{kStates}, .moves = 0}, 1, 2);
    filter.start(std::vector<LinearState>(kStates));
    filter.predict_groups(
        group, [&](size_t first, std::span<LinearState> states, std::span<uint8_t> alive) {
          ASSERT_EQ(states.size(), alive.size());
          ASSERT_LE(states.size(), group);
          for (size_t i = 0; i < states.size(); ++i) {
            states[i].predicted += double(first + i);
            alive[i] = (first + i) % 3 != 0;
          }
        });
    const auto& set = filter.particles();
    for (size_t i = 0; i < kStates; ++i) EXPECT_EQ(set.states[i].predicted, double(i));
    EXPECT_EQ(filter
                  .update(
                      0, [](const LinearState&) { return 0.0; }, move)
                  .dead,
              34);
  }
}

TEST(ParticleFilter, OneParticleSurvives) {
  const LinearRun run = run_linear({.particles = 1, .moves = 2}, 0.1, 10, 1, 3);
  for (const double mean : run.mean) EXPECT_TRUE(std::isfinite(mean));
}

TEST(ParticleFilter, LikelihoodsAMillionNatsApartLeaveFiniteWeights) {
  ParticleFilter<LinearState> filter({.particles = 100, .moves = 1}, 1, 1);
  filter.start(std::vector<LinearState>(100));
  const auto propagate = [](LinearState& s, uint32_t i) {
    s.predicted = i;
    return true;
  };
  const auto log_likelihood = [](const LinearState& s) { return -1e6 * s.predicted; };
  const auto move = [](LinearState&, double, Rng&) {};
  const FilterReport report = filter.step(0, propagate, log_likelihood, move);
  EXPECT_TRUE(std::isfinite(report.log_evidence));
  const auto& set = filter.particles();
  const std::vector<double> weights = normalised_weights(set.log_weights);
  for (size_t i = 0; i < weights.size(); ++i)
    EXPECT_EQ(weights[i] > 0, set.states[i].predicted == 0);
}

TEST(ParticleFilter, DeadParticlesAreCountedReplacedAndAllDeadIsReported) {
  ParticleFilter<LinearState> filter({.particles = 100, .moves = 0}, 1, 1);
  filter.start(std::vector<LinearState>(100));
  const auto flat = [](const LinearState&) { return 0.0; };
  const auto still = [](LinearState&, double, Rng&) {};
  const auto third_dies = [](LinearState& s, uint32_t i) {
    s.predicted = i % 3 == 0 ? -1 : 1;
    return i % 3 != 0;
  };
  FilterReport report = filter.step(0, third_dies, flat, still);
  EXPECT_EQ(report.dead, 34);
  EXPECT_FALSE(report.all_dead);
  EXPECT_NEAR(report.log_evidence, std::log(0.66), 1e-12);
  EXPECT_NEAR(report.ess, 66, 1e-9);
  report = filter.step(
      1, [](LinearState&, uint32_t) { return false; }, flat, still);
  EXPECT_TRUE(report.all_dead);
  EXPECT_EQ(report.dead, 100);
}

}  // namespace
}  // namespace walktrack
