// Events of linkage walkers that end a plain step: limits, flight, falls, stops.
#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "core/rng.h"
#include "tests/walker/kneed_files.h"
#include "walker/linkage/linkage_walker.h"
#include "walker/linkage/models.h"

namespace walktrack {
namespace {

using Eigen::Vector2d;
using Eigen::VectorXd;

TEST(LinkageWalker, SpreadLimitHoldsTheLegs) {
  StraightLeggedParameters p;
  p.slope = .010;
  p.widest_spread = 0.45;  // less than the gait's .515: the legs must stop against it
  const LinkageWalker walker(straight_legged(p));
  WalkerState state = walker.section_state(Vector2d(-.2, .2), Vector2d(.45, .2));
  double widest = 0;
  int stops = 0;
  std::vector<WalkerEvent> events;
  for (int i = 0; i < 4 && state.health == Health::kSound; ++i) {
    advance(walker, state, 6, {}, events, [&](const WalkerState& now) {
      widest = std::max(widest, std::abs(now.q(0) - now.q(1)));
    });
  }
  for (const WalkerEvent& event : events) stops += event.transition.kind == EventKind::kStop;
  EXPECT_GT(stops, 0);
  EXPECT_LT(widest, p.widest_spread + 1e-9);
}

// Running: when it is thrown upwards hard enough, the stance foot is released, the walker flies on
// a parabola and lands on the other foot.
TEST(LinkageWalker, FliesBallisticallyAndLands) {
  const CycleFile file = read_kneed_cycles();
  const ReferenceCycle& row = file.cycles.back();  // 1.8 m/s: its ground reaction would pull
  const LinkageWalker walker(kneed(file.parameters, row.controls, {.may_fly = true}));
  WalkerState state = walker.section_state(row.start.q, row.start.qd);
  std::vector<WalkerEvent> events;
  std::vector<WalkerState> flight;
  advance(walker, state, 1, {}, events, [&](const WalkerState& now) {
    if (now.phase == LinkageWalker::kFlight) flight.push_back(now);
  });
  ASSERT_GT(flight.size(), 5u);
  const WalkerState &first = flight.front(), &last = flight.back();
  const double t = last.time - first.time;
  const PlanarMomentum start = walker.momentum(first), end = walker.momentum(last);
  const Vector2d g(0, -file.parameters.gravity);
  EXPECT_LT((start.com + t * start.linear / start.mass + t * t / 2 * g - end.com).norm(),
            2e-7);  // RK4, stiff knees
  EXPECT_NEAR(end.angular, start.angular, 1e-7 * (1 + std::abs(start.angular)));
  EXPECT_TRUE(walker.contact_forces(first).empty());
}

TEST(LinkageWalker, FallsAreAStateAndFeetInOnePlaceAreNoStrike) {
  const LinkageWalker walker(straight_legged({}));
  WalkerState state = walker.section_state(Vector2d(0, 0), Vector2d(0, 0));
  std::vector<WalkerEvent> events;
  state.qd(0) = -0.5;  // falls backwards
  EXPECT_FALSE(advance(walker, state, 20, {}, events));
  EXPECT_EQ(state.health, Health::kFallen);
  EXPECT_TRUE(state.q.allFinite());
  state = walker.section_state(Vector2d(0, 0), Vector2d(0, 0));
  EXPECT_FALSE(advance(walker, state, 0.5, {}, events));  // an unstable balance without an event
  EXPECT_EQ(state.health, Health::kSound);
}

TEST(LinkageWalker, AStartThatLiesOnTheGroundHasFallen) {
  const LinkageWalker walker(straight_legged({}));
  EXPECT_EQ(walker.section_state(Vector2d(1.5, -1.5), Vector2d(0, 0)).health, Health::kFallen);
}

// Rates that differ from the cycle by 5 % flex knees at rest and straighten flexed ones. Some
// walkers fall; none has a stop that fires for ever.
TEST(LinkageWalker, DisturbedWalksEndInNoChatter) {
  const CycleFile file = read_kneed_cycles();
  const ReferenceCycle& row = file.cycles.back();
  const LinkageWalker walker(kneed(file.parameters, row.controls, {.may_fly = false}));
  for (uint32_t i = 0; i < 16; ++i) {
    Rng rng(25, Purpose::kTest, i);
    VectorXd rates = row.start.qd;
    for (double& rate : rates) rate *= 1 + 0.05 * rng.normal();
    WalkerState state = walker.section_state(row.start.q, rates);
    std::vector<WalkerEvent> events;
    while (state.health == Health::kSound && state.time < 3) {
      if (!advance(walker, state, 3 - state.time, {}, events)) break;
    }
    EXPECT_NE(state.health, Health::kDiverged) << i << " at " << state.time << " s";
  }
}

}  // namespace
}  // namespace walktrack
