#include "walker/kneed/kneed_batch.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "core/rng.h"
#include "tests/walker/kneed_files.h"
#include "tests/walker/spread.h"
#include "walker/lanes/lanes.h"

namespace walktrack {
namespace {

struct Crowd {
  std::vector<KneedControls> controls;
  std::vector<Vector5> noise;
  std::vector<double> durations;
  std::vector<KneedState> states;
  std::vector<KneedAdvance> results;
  size_t size() const { return states.size(); }
};

class KneedBatch : public testing::Test {
 protected:
  CycleFile file = read_kneed_cycles();
  KneedModel model = kneed_model(file.parameters);

  // Walkers of all cycles at any moment of a step, perturbed by up to `push` rad and 10 `push`
  // rad/s.
  Crowd crowd(size_t count, double duration, double push) const {
    Crowd c;
    for (size_t i = 0; i < count; ++i) {
      Rng rng(1, Purpose::kTest, 0, static_cast<uint32_t>(i));
      const ReferenceCycle& cycle = file.cycles[i % file.cycles.size()];
      KneedState state = cycle.start;
      kneed_advance(model, cycle.controls, Vector5::Zero(), state, cycle.period * rng.uniform());
      Vector5 noise;
      for (int k = 0; k < 5; ++k) {
        state.q[k] += spread(rng, push);
        state.qd[k] += spread(rng, 10 * push);
        noise[k] = spread(rng, 5);
      }
      c.states.push_back(state);
      c.controls.push_back(cycle.controls);
      c.noise.push_back(noise);
      c.durations.push_back(duration);
    }
    c.results.resize(count);
    return c;
  }

  void advance(Crowd& c) const {
    kneed_advance_batch(model, c.controls, c.noise, c.durations, c.states, c.results);
  }
  void advance_one_by_one(Crowd& c) const {
    for (size_t i = 0; i < c.size(); ++i)
      c.results[i] = kneed_advance(model, c.controls[i], c.noise[i], c.states[i], c.durations[i]);
  }
};

double distance(const KneedState& a, const KneedState& b) {
  return std::max({(a.q - b.q).cwiseAbs().maxCoeff(), (a.qd - b.qd).cwiseAbs().maxCoeff(),
                   std::abs(a.contact_x - b.contact_x), std::abs(a.clearance - b.clearance),
                   std::abs(a.since_transfer - b.since_transfer)});
}

void expect_agreement(const Crowd& batch, const Crowd& scalar, double tolerance) {
  size_t given_up = 0;
  for (size_t i = 0; i < batch.size(); ++i) {
    SCOPED_TRACE(i);
    const KneedAdvance &a = batch.results[i], &b = scalar.results[i];
    // Two knees that push each other off their stops, ever more slowly, end at rounding: either
    // code may come to rest or give up.
    if (a.event != b.event && b.event == KneedEvent::kDiverged) {
      EXPECT_LE(++given_up, batch.size() / 100);
      continue;
    }
    ASSERT_EQ(a.event, b.event);
    EXPECT_NEAR(a.elapsed, b.elapsed, tolerance);
    EXPECT_NEAR(a.step_length, b.step_length, tolerance);
    EXPECT_NEAR(a.clearance, b.clearance, tolerance);
    EXPECT_LT((a.impulse - b.impulse).norm(), 1e3 * tolerance);  // N s, of some hundred
    if (a.event == KneedEvent::kDiverged) continue;
    EXPECT_LT(distance(batch.states[i], scalar.states[i]), tolerance);
    EXPECT_EQ(batch.states[i].stance_stop, scalar.states[i].stance_stop);
    EXPECT_EQ(batch.states[i].swing_stop, scalar.states[i].swing_stop);
    EXPECT_EQ(batch.states[i].transfers, scalar.states[i].transfers);
  }
}

size_t count(const Crowd& c, KneedEvent event) {
  return static_cast<size_t>(std::count_if(
      c.results.begin(), c.results.end(), [&](const KneedAdvance& r) { return r.event == event; }));
}

bool same_bytes(const KneedState& a, const KneedState& b) {
  return a.q == b.q && a.qd == b.qd && a.contact_x == b.contact_x && a.clearance == b.clearance &&
         a.since_transfer == b.since_transfer && a.stance_stop == b.stance_stop &&
         a.swing_stop == b.swing_stop;
}

// To the end of their steps, through knee stops and strikes. Rounding of 1e-16 grows a thousandfold
// at most in a step.
TEST_F(KneedBatch, IsTheScalarModelForAThousandRandomStates) {
  Crowd batch = crowd(1000, 1.0, 0.02), scalar = batch;
  advance(batch);
  advance_one_by_one(scalar);
  expect_agreement(batch, scalar, 1e-9);
  EXPECT_GT(count(batch, KneedEvent::kTransfer), 800u);
}

TEST_F(KneedBatch, IsTheScalarModelForThoseWhoFallAndThoseWhoStopEarly) {
  Crowd batch = crowd(1000, 0.1, 0.35);
  for (size_t i = 0; i < batch.size(); ++i)
    batch.durations[i] = 1e-3 * static_cast<double>(1 + i % 300);
  Crowd scalar = batch;
  advance(batch);
  advance_one_by_one(scalar);
  // Knees that push each other off their stops amplify rounding tenfold each time.
  expect_agreement(batch, scalar, 1e-8);
  EXPECT_GT(count(batch, KneedEvent::kTransfer), 50u);
  EXPECT_GT(count(batch, KneedEvent::kFallen), 50u);
  EXPECT_GT(count(batch, KneedEvent::kNone), 50u);
}

TEST_F(KneedBatch, IsTheScalarModelOnASlopeWithOtherLimits) {
  KneedParameters steep = file.parameters;
  steep.slope = 0.1;
  const KneedModel sloped = kneed_model(steep);
  const KneedLimits limits{.max_step = 0.001, .min_hip_height = 0.9, .max_torso_lean = 0.3};
  Crowd batch = crowd(200, 0.5, 0.05), scalar = batch;
  kneed_advance_batch(sloped, batch.controls, batch.noise, batch.durations, batch.states,
                      batch.results, limits);
  for (size_t i = 0; i < scalar.size(); ++i)
    scalar.results[i] = kneed_advance(sloped, scalar.controls[i], scalar.noise[i], scalar.states[i],
                                      scalar.durations[i], limits);
  expect_agreement(batch, scalar, 1e-9);
  EXPECT_GT(count(batch, KneedEvent::kFallen), 10u);
}

TEST_F(KneedBatch, DivergedWalkersAreReportedAndDisturbNobody) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Crowd batch = crowd(64, 0.2, 0.02), healthy = batch;
  batch.states[3].q[kTorso] = nan;
  batch.states[17].qd[kSwingShank] = 1e9;
  batch.controls[20].hip.stiffness = 1e22;
  batch.noise[40][kTorso] = std::numeric_limits<double>::infinity();
  batch.noise[41][kTorso] = 1e8;  // valid at first, too fast within the step
  advance(batch);
  advance(healthy);
  for (size_t i = 0; i < batch.size(); ++i) {
    const bool ill = i == 3 || i == 17 || i == 20 || i == 40 || i == 41;
    EXPECT_EQ(batch.results[i].event == KneedEvent::kDiverged, ill) << i;
    EXPECT_TRUE(ill || same_bytes(batch.states[i], healthy.states[i])) << i;
  }
}

// The result does not depend on the other walkers in the batch, nor on the place in it.
TEST_F(KneedBatch, DependsOnNobodyElse) {
  Crowd all = crowd(101, 0.3, 0.05);
  const Crowd before = all;
  advance(all);
  for (const size_t size : {size_t{1}, size_t{2}, size_t{3}, size_t{7}, size_t{8}, size_t{13}}) {
    for (size_t first = 0; first < all.size(); first += size) {
      Crowd part;
      for (size_t i = std::min(first + size, all.size()); i-- > first;) {  // backwards
        part.states.push_back(before.states[i]);
        part.controls.push_back(before.controls[i]);
        part.noise.push_back(before.noise[i]);
        part.durations.push_back(before.durations[i]);
      }
      part.results.resize(part.size());
      advance(part);
      for (size_t k = 0; k < part.size(); ++k) {
        const size_t i = first + part.size() - 1 - k;
        ASSERT_TRUE(same_bytes(part.states[k], all.states[i])) << i << " of " << size;
        ASSERT_EQ(part.results[k].elapsed, all.results[i].elapsed);
      }
    }
  }
}

TEST_F(KneedBatch, NoWalkersAndNoTime) {
  Crowd none;
  advance(none);
  Crowd still = crowd(5, 0, 0), before = still;
  advance(still);
  for (size_t i = 0; i < still.size(); ++i) {
    EXPECT_EQ(still.results[i].event, KneedEvent::kNone);
    EXPECT_EQ(still.results[i].elapsed, 0);
    EXPECT_LT(distance(still.states[i], before.states[i]), 1e-12);
  }
}

// Every instruction set of this machine agrees; those with fused multiply-add to the byte.
TEST_F(KneedBatch, InstructionSetsAgree) {
  const Crowd before = crowd(200, 0.4, 0.03);
  Crowd best = before;
  advance(best);
  const std::string best_name = lane_target();
  int tried = 0;
  for (const int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(target);
    SCOPED_TRACE(lane_target());
    Crowd other = before;
    advance(other);
    expect_agreement(other, best, 1e-9);
    const std::string name = lane_target();
    const bool fused = name.starts_with("AVX") && best_name.starts_with("AVX");
    for (size_t i = 0; i < other.size(); ++i)
      EXPECT_TRUE(!fused || same_bytes(other.states[i], best.states[i])) << i;
    ++tried;
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().DeInit();
  EXPECT_GE(tried, 1);
  EXPECT_EQ(lane_target(), best_name);
}

}  // namespace
}  // namespace walktrack
