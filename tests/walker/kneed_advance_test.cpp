#include "walker/kneed/kneed_advance.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/rng.h"
#include "tests/walker/kneed_files.h"
#include "walker/kneed/kneed_stops.h"

namespace walktrack {
namespace {

const Vector5 kQuiet = Vector5::Zero();

class KneedCycles : public testing::Test {
 protected:
  CycleFile file = read_kneed_cycles();
  KneedModel model = kneed_model(file.parameters);
};

bool lets_go_of_stance_knee(const ReferenceCycle& cycle) {
  return cycle.controls.torso.damping < 100 && cycle.controls.torso.stiffness > 1200;
}

TEST_F(KneedCycles, ReturnToTheirStart) {
  ASSERT_EQ(file.cycles.size(), 9u);
  for (const auto& cycle : file.cycles) {
    SCOPED_TRACE(cycle.speed);
    KneedState state = cycle.start;
    KneedLimits fine;
    fine.max_step = 0.001;
    const auto run = kneed_advance(model, cycle.controls, kQuiet, state, 2, fine);
    ASSERT_EQ(run.event, KneedEvent::kTransfer);
    // The file's states have 12 digits, its periods and steps four. In the two cycles whose stance
    // stop is released, the file released it only at the end of a 1 ms step, 0.65 and 0.97 ms late
    // (doing the same here gives 4e-9); with the event located, they end 0.9e-4 and 4.1e-4 rad/s
    // away.
    const double tolerance = lets_go_of_stance_knee(cycle) ? 5e-4 : 1e-7;
    EXPECT_LT((state.q - cycle.start.q).cwiseAbs().maxCoeff(), tolerance);
    EXPECT_LT((state.qd - cycle.start.qd).cwiseAbs().maxCoeff(), tolerance);
    EXPECT_NEAR(run.elapsed, cycle.period, 1e-4);
    EXPECT_NEAR(run.step_length, cycle.step_length, 1e-4);
    EXPECT_NEAR(run.clearance, cycle.clearance, 1.5e-3);  // the file's is not a local minimum
    // The body moves additionally by the rolling of the stance foot.
    const double roll = cycle.start.q[kSwingShank] - cycle.start.q[kStanceShank];
    EXPECT_NEAR(state.contact_x, run.step_length + file.parameters.foot_radius * roll, tolerance);
    EXPECT_GT(run.impulse.y(), 0);
  }
}

TEST_F(KneedCycles, DefaultStepChangesThemLittle) {
  for (const auto& cycle : file.cycles) {
    KneedState state = cycle.start;
    kneed_advance(model, cycle.controls, kQuiet, state, 2);
    // 4 ms against 1 ms at fourth order; the worst cycle has 8.4 kN m/rad in the torso.
    EXPECT_LT((state.qd - cycle.start.qd).cwiseAbs().maxCoeff(), 1e-3) << cycle.speed;
  }
}

TEST_F(KneedCycles, DurationMayBeCutAnywhere) {
  const auto& cycle = file.cycles[2];
  KneedState whole = cycle.start, pieces = cycle.start;
  KneedLimits fine;
  fine.max_step = 0.0005;
  kneed_advance(model, cycle.controls, kQuiet, whole, 0.5, fine);
  for (const double part : {0.1, 0.017, 0.0, 0.283, 0.1}) {
    const auto run = kneed_advance(model, cycle.controls, kQuiet, pieces, part, fine);
    EXPECT_EQ(run.elapsed, part);
    EXPECT_EQ(run.event, KneedEvent::kNone);
  }
  EXPECT_LT((whole.qd - pieces.qd).cwiseAbs().maxCoeff(), 1e-8);
  EXPECT_NEAR(pieces.since_transfer, 0.5, 1e-12);
}

TEST_F(KneedCycles, StableOnesKeepWalkingAndTheGroundOnlyPushes) {
  const auto& cycle = file.cycles[5];
  KneedState state = cycle.start;
  double time = 0;
  while (state.transfers < 30) {
    const auto run = kneed_advance(model, cycle.controls, kQuiet, state, 2);
    ASSERT_EQ(run.event, KneedEvent::kTransfer);
    EXPECT_GT(run.impulse.y(), 0);
    time += run.elapsed;
  }
  const double roll = file.parameters.foot_radius * (state.q[kSwingShank] - state.q[kStanceShank]);
  EXPECT_NEAR((state.contact_x - 30 * roll) / time, cycle.speed, 0.002);
}

TEST_F(KneedCycles, PostureIsContinuousThroughTheStrike) {
  const auto& cycle = file.cycles[3];
  KneedState before = cycle.start;
  kneed_advance(model, cycle.controls, kQuiet, before, cycle.period - 1e-4);
  const KneedPosture a = kneed_posture(model, before);
  KneedState after = before;
  ASSERT_EQ(kneed_advance(model, cycle.controls, kQuiet, after, 1).event, KneedEvent::kTransfer);
  const KneedPosture b = kneed_posture(model, after);
  // 0.1 ms at no more than 10 m/s.
  EXPECT_LT((a.hip - b.hip).norm(), 1e-3);
  EXPECT_LT((a.swing_foot - b.stance_foot).norm(), 1e-3);
  EXPECT_LT((a.stance_knee - b.swing_knee).norm(), 1e-3);
}

// Fourth order away from events: the error falls 16-fold when the step is halved.
TEST_F(KneedCycles, ConvergeAtFourthOrder) {
  const auto& cycle = file.cycles[6];
  const auto end = [&](double step) {
    KneedState state = cycle.start;
    KneedLimits limits;
    limits.max_step = step;
    // The first 0.05 s: the stance knee leaves its stop at once, the swing knee is free.
    kneed_advance(model, cycle.controls, kQuiet, state, 0.05, limits);
    return state.qd;
  };
  const Vector5 exact = end(0.05 / 1024);
  const double coarse = (end(0.05 / 64) - exact).norm(), fine = (end(0.05 / 128) - exact).norm();
  EXPECT_GT(coarse, 1e-11);
  EXPECT_NEAR(std::log2(coarse / fine), 4, 0.4);
}

TEST_F(KneedCycles, EventsConvergeToo) {
  const auto& cycle = file.cycles[1];
  const auto end = [&](double step) {
    KneedState state = cycle.start;
    KneedLimits limits;
    limits.max_step = step;
    kneed_advance(model, cycle.controls, kQuiet, state, 2, limits);
    return state.qd;
  };
  const Vector5 exact = end(0.00025);
  EXPECT_LT((end(0.001) - exact).norm(), 1e-6);
  EXPECT_LT((end(0.004) - exact).norm(), 1e-4);
}

TEST_F(KneedCycles, StopsNeverPullAndKneesNeverBendBackwards) {
  for (const auto& cycle : file.cycles) {
    KneedState state = cycle.start;
    int held = 0;
    for (int i = 0; i < 1500; ++i) {
      const auto run = kneed_advance(model, cycle.controls, kQuiet, state, 0.001);
      ASSERT_TRUE(run.event == KneedEvent::kNone || run.event == KneedEvent::kTransfer);
      EXPECT_GE(state.q[kStanceShank] - state.q[kStanceThigh], -1e-9);
      EXPECT_GE(state.q[kSwingShank] - state.q[kSwingThigh], -1e-9);
      const auto a = kneed_accelerations(model, cycle.controls, kQuiet, state);
      EXPECT_GE(a.stop_torque[0], -1e-9);
      EXPECT_GE(a.stop_torque[1], -1e-9);
      held += state.stance_stop || state.swing_stop;
    }
    EXPECT_GT(held, 0) << "this cycle never used a stop: the test is empty";
  }
}

TEST_F(KneedCycles, SettlingIsComplementary) {
  const KneedControls controls = file.cycles[2].controls;
  int struck_both = 0;
  for (uint32_t n = 0; n < 500; ++n) {
    Rng rng(3, Purpose::kTest, 0, n);
    KneedState state;
    for (int k = 0; k < 5; ++k) {
      state.q[k] = 0.4 * rng.normal();
      state.qd[k] = 3 * rng.normal();
    }
    state.q[kStanceShank] = state.q[kStanceThigh];
    state.q[kSwingShank] = state.q[kSwingThigh];
    KneedState after = state;
    const auto impulse = settle_knee_stops(model, controls, kQuiet, after);
    const auto rate = [&](int knee) {
      return after.qd[knee ? kSwingShank : kStanceShank] -
             after.qd[knee ? kSwingThigh : kStanceThigh];
    };
    for (int knee = 0; knee < 2; ++knee) {
      EXPECT_GE(impulse[size_t(knee)], 0);
      EXPECT_GE(rate(knee), -1e-9);
      EXPECT_NEAR(impulse[size_t(knee)] * rate(knee), 0, 1e-9);
    }
    struck_both += impulse[0] > 0 && impulse[1] > 0;
    EXPECT_LE(kneed_energy(model, after).kinetic, kneed_energy(model, state).kinetic + 1e-9);
  }
  EXPECT_GT(struck_both, 20);
}

TEST_F(KneedCycles, HyperextendedStateIsPutOnItsStop) {
  KneedState state = file.cycles[2].start;
  state.q[kSwingShank] = state.q[kSwingThigh] - 0.1;
  settle_knee_stops(model, file.cycles[2].controls, kQuiet, state);
  EXPECT_EQ(state.q[kSwingShank], state.q[kSwingThigh]);
  EXPECT_GE(state.qd[kSwingShank], state.qd[kSwingThigh]);
}

// A foot dragged along the ground passes the stance foot below it: if it still sinks it strikes
// there, if it rises the walker stumbles.
TEST_F(KneedCycles, ScuffingFootStrikesOrStumblesWhenItPasses) {
  KneedState sinking;
  sinking.q << 0, -0.3, -0.09, 0.3, -0.09;  // the bent stance knee lowers the straight swing leg
  sinking.qd << 0, -3, -3, 3, -3;
  const SwingFoot foot = kneed_swing_foot(model, sinking);
  ASSERT_LT(foot.height, 0);
  ASSERT_LT(foot.lead, 0);
  ASSERT_GT(foot.lead_rate, 0);
  ASSERT_LT(foot.height_rate, 0);
  KneedState rising = sinking;
  rising.qd << 0, 3, -3, -3, -3;
  ASSERT_GT(kneed_swing_foot(model, rising).height_rate, 0);
  const auto strike = kneed_advance(model, KneedControls{}, kQuiet, sinking, 0.2);
  EXPECT_EQ(strike.event, KneedEvent::kTransfer);
  EXPECT_NEAR(strike.step_length, 0, 1e-9);
  EXPECT_EQ(kneed_advance(model, KneedControls{}, kQuiet, rising, 0.2).event, KneedEvent::kFallen);
}

TEST_F(KneedCycles, LimpWalkerFallsAndBrokenStateDiverges) {
  KneedState limp = file.cycles[2].start;
  limp.qd.setZero();
  double time = 0;
  KneedEvent event = KneedEvent::kNone;
  while (time < 5 && (event == KneedEvent::kNone || event == KneedEvent::kTransfer)) {
    const auto run = kneed_advance(model, KneedControls{}, kQuiet, limp, 5);
    time += run.elapsed;
    event = run.event;
  }
  EXPECT_EQ(event, KneedEvent::kFallen);
  KneedState broken = file.cycles[2].start;
  broken.qd[2] = std::nan("");
  EXPECT_EQ(kneed_advance(model, KneedControls{}, kQuiet, broken, 1).event, KneedEvent::kDiverged);
  Vector5 bad_noise = Vector5::Constant(std::numeric_limits<double>::infinity());
  KneedState state = file.cycles[2].start;
  EXPECT_EQ(kneed_advance(model, KneedControls{}, bad_noise, state, 1).event,
            KneedEvent::kDiverged);
  EXPECT_TRUE(state.qd.allFinite());
}

// For any extreme input the result is a finite state or a status, after a bounded time.
TEST_F(KneedCycles, ExtremesEndInAStateOrAStatus) {
  int walked = 0;
  for (const double stiffness : {1e-3, 1e-1, 1.0, 10.0, 1e3})
    for (const double slope_deg : {-45.0, -5.0, 0.0, 5.0, 45.0})
      for (const double dt : {1e-5, 1e-3, 1.0 / 60, 1.0 / 15}) {
        const auto& cycle = file.cycles[2];
        KneedParameters p = file.parameters;
        p.slope = slope_deg * 0.017453292519943295;
        const KneedModel tilted = kneed_model(p);
        KneedControls c = cycle.controls;
        for (SpringDamper* s : {&c.torso, &c.hip, &c.stance_knee, &c.swing_knee}) {
          s->stiffness *= stiffness;
          s->damping *= stiffness;
        }
        KneedState state = cycle.start;
        KneedEvent event = KneedEvent::kNone;
        for (int i = 0; i < 12 && event != KneedEvent::kFallen && event != KneedEvent::kDiverged;
             ++i)
          event = kneed_advance(tilted, c, kQuiet, state, dt).event;
        EXPECT_TRUE(state.q.allFinite() && state.qd.allFinite());
        walked += event == KneedEvent::kNone || event == KneedEvent::kTransfer;
      }
  EXPECT_GT(walked, 40);
}

TEST_F(KneedCycles, StepSizeFollowsStiffnessAndDamping) {
  const auto& cycle = file.cycles[2];
  const double normal = kneed_step_size(model, cycle.controls, cycle.start, 1);
  KneedControls stiff = cycle.controls;
  stiff.torso.stiffness *= 1e8;
  EXPECT_LT(kneed_step_size(model, stiff, cycle.start, 1), 1e-2 * normal);
  EXPECT_EQ(kneed_step_size(model, cycle.controls, cycle.start, 1e-4), 1e-4);
}

}  // namespace
}  // namespace walktrack
