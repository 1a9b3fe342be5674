#include "walker/straight/straight_batch.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/parallel_for.h"
#include "core/rng.h"
#include "tests/walker/spread.h"
#include "walker/linkage/linkage_walker.h"
#include "walker/simulate.h"

namespace walktrack {
namespace {

struct LegsCrowd {
  std::vector<StraightControls> controls;
  std::vector<Vector2> noise;
  std::vector<double> durations;
  std::vector<StraightState> states;
  std::vector<StraightAdvance> results;
  size_t size() const { return states.size(); }
};

// Fixed points of configs/models: kuo_level, kuo_level_spring, kuo_level_unstable.
struct Published {
  StraightControls controls;
  Vector2 q, qd;
};
const std::vector<Published> kPublished{
    {{0, 0.06}, {-0.309104598, 0.309104598}, {0.334156693, 0.267997464}},
    {{0.1, 0.1}, {-0.335708232, 0.335708232}, {0.512001304, 0.393117244}},
    {{0.05, 0.1}, {-0.357459851, 0.357459851}, {0.479461382, 0.35524949}}};

class StraightBatch : public testing::Test {
 protected:
  // Sub-steps of the linkage and of the batch are equal if durations are multiples of them.
  static constexpr double kStep = 0.01;
  StraightLeggedParameters parameters{.gravity = 1};
  StraightModel model = straight_model(parameters);

  // After transfers of the published cycles, perturbed.
  LegsCrowd crowd(size_t count, double duration, double push) const {
    LegsCrowd c;
    for (size_t i = 0; i < count; ++i) {
      Rng rng(2, Purpose::kTest, 0, static_cast<uint32_t>(i));
      const Published& gait = kPublished[i % kPublished.size()];
      StraightState state;
      const double turn = spread(rng, push);
      state.q = gait.q + Vector2(-turn, turn);
      state.qd = gait.qd + Vector2(spread(rng, push), spread(rng, push));
      c.controls.push_back(gait.controls);
      c.noise.push_back({spread(rng, 0.1 * push), spread(rng, 0.1 * push)});
      c.durations.push_back(duration);
      c.states.push_back(state);
    }
    c.results.resize(count);
    return c;
  }

  void advance(LegsCrowd& c) const {
    straight_advance_batch(model, c.controls, c.noise, c.durations, c.states, c.results, kStep);
  }

  // The general implementation, without noise.
  StraightAdvance by_linkage(const StraightControls& controls, StraightState& state,
                             double duration) const {
    StraightLeggedParameters p = parameters;
    p.hip_stiffness = controls.stiffness;
    p.toe_off_impulse = controls.toe_off_impulse;
    const LinkageWalker walker(straight_legged(p));
    WalkerState s = walker.section_state(state.q, state.qd);
    s.contacts[0] = state.contact_x;
    std::vector<WalkerEvent> events;
    const bool stepped = walktrack::advance(walker, s, duration, {.max_step = kStep}, events);
    StraightAdvance result{.elapsed = s.time};
    result.event = stepped                       ? KneedEvent::kTransfer
                   : s.health == Health::kFallen ? KneedEvent::kFallen
                                                 : KneedEvent::kNone;
    if (stepped) {
      result.impulse = events.back().transition.impulse;
      result.step_length = events.back().transition.feet_apart;
      result.toe_off_work = events.back().transition.actuator_work;
    }
    state.q = s.q;
    state.qd = s.qd;
    state.contact_x = s.contacts[0];
    return result;
  }
};

bool same_bytes(const StraightState& a, const StraightState& b) {
  return a.q == b.q && a.qd == b.qd && a.contact_x == b.contact_x &&
         a.since_transfer == b.since_transfer && a.transfers == b.transfers;
}

// Rounding of 1e-16 and events located to 1e-12 grow a thousandfold at most in a step.
TEST_F(StraightBatch, IsTheLinkageForRandomStates) {
  LegsCrowd batch = crowd(150, 4, 0.1);
  std::fill(batch.noise.begin(), batch.noise.end(), Vector2::Zero());
  LegsCrowd general = batch;
  advance(batch);
  size_t transfers = 0, fallen = 0;
  for (size_t i = 0; i < batch.size(); ++i) {
    SCOPED_TRACE(i);
    general.results[i] = by_linkage(general.controls[i], general.states[i], general.durations[i]);
    const StraightAdvance &a = batch.results[i], &b = general.results[i];
    ASSERT_EQ(a.event, b.event);
    fallen += a.event == KneedEvent::kFallen;
    if (a.event == KneedEvent::kFallen)
      continue;  // the linkage locates the time at which the hip
                 // has a height
    transfers += a.event == KneedEvent::kTransfer;
    EXPECT_NEAR(a.elapsed, b.elapsed, 1e-9);
    EXPECT_NEAR(a.step_length, b.step_length, 1e-9);
    EXPECT_NEAR(a.toe_off_work, b.toe_off_work, 1e-9);
    EXPECT_LT((a.impulse - b.impulse).norm(), 1e-9);
    EXPECT_LT((batch.states[i].q - general.states[i].q).norm(), 1e-9);
    EXPECT_LT((batch.states[i].qd - general.states[i].qd).norm(), 1e-9);
    EXPECT_NEAR(batch.states[i].contact_x, general.states[i].contact_x, 1e-9);
  }
  EXPECT_GT(transfers, 70u);
  EXPECT_GT(fallen, 5u);
}

// The same with SI numbers on a slope: accelerations and ground forces in mid-step.
TEST_F(StraightBatch, AccelerationsAndForcesAreTheLinkages) {
  const StraightLeggedParameters p{.gravity = 9.8,
                                   .slope = 0.07,
                                   .hip_mass = 40,
                                   .leg_mass = 12,
                                   .leg_inertia = 0.9,
                                   .hip_to_arc = 0.6,
                                   .com_below_hip = 0.33,
                                   .foot_radius = 0.27,
                                   .hip_stiffness = 30};
  const LinkageWalker walker(straight_legged(p));
  const StraightModel general = straight_model(p);
  for (uint32_t i = 0; i < 100; ++i) {
    Rng rng(3, Purpose::kTest, 0, i);
    StraightState s;
    s.q = {spread(rng, 0.6), spread(rng, 0.6)};
    s.qd = {spread(rng, 3), spread(rng, 3)};
    const WalkerState w = walker.section_state(s.q, s.qd);
    const Vector2 qdd = straight_accelerations(general, p.hip_stiffness, Vector2::Zero(), s);
    EXPECT_LT((walker.acceleration(w) - qdd).norm(), 1e-10);  // rounding of some 100 rad/s^2
    EXPECT_LT((walker.contact_forces(w)[0].force - straight_contact_force(general, s, qdd)).norm(),
              1e-9);
  }
}

// Torques do work: the energy that they add over a short time is their power.
TEST_F(StraightBatch, NoiseIsATorqueOnTheLegs) {
  StraightState s;
  s.q = {-0.1, 0.2};
  const Vector2 torque(0.02, -0.01);
  const Vector2 free = straight_accelerations(model, 0.1, Vector2::Zero(), s);
  const Vector2 pushed = straight_accelerations(model, 0.1, torque, s);
  StraightState moved = s, alone = s;
  constexpr double kShort = 1e-3;
  straight_advance(model, {0.1, 0}, torque, moved, kShort);
  straight_advance(model, {0.1, 0}, Vector2::Zero(), alone, kShort);
  EXPECT_LT(((moved.qd - alone.qd) / kShort - (pushed - free)).norm(), 1e-5 * pushed.norm());
  EXPECT_GT((pushed - free).norm(), 0.1);
}

TEST_F(StraightBatch, PublishedCyclesReturn) {
  for (const Published& gait : kPublished) {
    StraightState s;
    s.q = gait.q;
    s.qd = gait.qd;
    const StraightAdvance run =
        straight_advance(model, gait.controls, Vector2::Zero(), s, 5, kStep);
    EXPECT_EQ(run.event, KneedEvent::kTransfer);
    EXPECT_LT((s.q - gait.q).norm() + (s.qd - gait.qd).norm(), 5e-9);  // nine digits published
    EXPECT_EQ(s.transfers, 1);
    EXPECT_EQ(s.since_transfer, 0);
  }
}

TEST_F(StraightBatch, IllWalkersHarmNobody) {
  LegsCrowd batch = crowd(60, 1, 0.05), healthy = batch;
  batch.states[3].q[0] = std::numeric_limits<double>::quiet_NaN();
  batch.states[17].qd[1] = 1e9;
  batch.controls[20].stiffness = 1e22;
  batch.noise[40][0] = std::numeric_limits<double>::infinity();
  advance(batch);
  advance(healthy);
  for (size_t i = 0; i < batch.size(); ++i) {
    const bool ill = i == 3 || i == 17 || i == 20 || i == 40;
    EXPECT_EQ(batch.results[i].event == KneedEvent::kDiverged, ill) << i;
    EXPECT_TRUE(ill || same_bytes(batch.states[i], healthy.states[i])) << i;
  }
}

// In groups of any size, on any number of threads: the same bytes.
TEST_F(StraightBatch, DependsOnNobodyElseNorOnThreads) {
  LegsCrowd all = crowd(101, 2.5, 0.1);
  const LegsCrowd before = all;
  advance(all);
  for (const int threads : {1, 2, 3})
    for (const size_t size : {size_t{1}, size_t{3}, size_t{8}, size_t{13}}) {
      LegsCrowd parts = before;
      parallel_for((all.size() + size - 1) / size, threads, [&](size_t part) {
        const size_t first = part * size, n = std::min(size, all.size() - first);
        const auto piece = [&](auto& items) { return std::span(items).subspan(first, n); };
        straight_advance_batch(model, piece(parts.controls), piece(parts.noise),
                               piece(parts.durations), piece(parts.states), piece(parts.results),
                               kStep);
      });
      for (size_t i = 0; i < all.size(); ++i) {
        ASSERT_TRUE(same_bytes(parts.states[i], all.states[i])) << i << " of " << size;
        ASSERT_EQ(parts.results[i].elapsed, all.results[i].elapsed);
      }
    }
}

TEST_F(StraightBatch, NoWalkersAndNoTime) {
  LegsCrowd none;
  advance(none);
  LegsCrowd still = crowd(5, 0, 0.1), before = still;
  advance(still);
  for (size_t i = 0; i < still.size(); ++i) {
    EXPECT_EQ(still.results[i].event, KneedEvent::kNone);
    EXPECT_TRUE(same_bytes(still.states[i], before.states[i]));
  }
}

// Every instruction set of this machine agrees.
TEST_F(StraightBatch, InstructionSetsAgree) {
  const LegsCrowd before = crowd(100, 2.5, 0.05);
  LegsCrowd best = before;
  advance(best);
  int tried = 0;
  for (const int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(target);
    LegsCrowd other = before;
    advance(other);
    for (size_t i = 0; i < other.size(); ++i) {
      ASSERT_EQ(other.results[i].event, best.results[i].event);
      EXPECT_LT((other.states[i].q - best.states[i].q).norm() +
                    (other.states[i].qd - best.states[i].qd).norm(),
                1e-9);
    }
    ++tried;
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().DeInit();
  EXPECT_GE(tried, 1);
}

}  // namespace
}  // namespace walktrack
