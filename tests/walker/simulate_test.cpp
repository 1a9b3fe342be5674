#include "walker/simulate.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include <gtest/gtest.h>

namespace walktrack {
namespace {

using Eigen::VectorXd;

// Balls thrown up under g = 1; the test defines guards and events.
class Balls : public Walker {
 public:
  std::function<std::vector<Guard>(const WalkerState&)> guards_of;
  std::function<std::optional<Transition>(int, const WalkerState&)> event_of;
  double gravity = 1;

  std::vector<std::string> coordinates() const override { return {"z"}; }
  size_t section_size() const override { return 1; }
  double weight() const override { return 1; }
  WalkerState settled(WalkerState state) const override { return state; }
  VectorXd acceleration(const WalkerState& state) const override {
    return VectorXd::Constant(state.q.size(), -gravity);
  }
  std::vector<Guard> guards(const WalkerState& state) const override { return guards_of(state); }
  std::optional<Transition> event(int id, const WalkerState& state) const override {
    return event_of(id, state);
  }
  WalkerEnergy energy(const WalkerState&) const override { return {}; }
  VectorXd actuator_powers(const WalkerState&) const override { return {}; }
  std::vector<ContactForce> contact_forces(const WalkerState&) const override { return {}; }
  PlanarMomentum momentum(const WalkerState&) const override { return {}; }
  std::vector<Stroke> strokes(const WalkerState&) const override { return {}; }
  WalkerState section_state(const VectorXd& q, const VectorXd& qd) const override {
    WalkerState state;
    state.q = q;
    state.qd = qd;
    return state;
  }
  VectorXd section_point(const WalkerState& state) const override { return state.q; }
  Eigen::MatrixXd section_rows(const WalkerState&) const override { return {}; }
};

// Every ball bounces off the ground with a restitution.
Balls bouncing(double restitution) {
  Balls balls;
  balls.guards_of = [](const WalkerState& state) {
    std::vector<Guard> guards;
    for (int i = 0; i < state.q.size(); ++i) guards.push_back({i, state.q(i), state.qd(i)});
    return guards;
  };
  balls.event_of = [restitution](int id, const WalkerState& state) {
    Transition bounce;
    bounce.after = state;
    bounce.index = id;
    bounce.after.qd(id) *= -restitution;
    return std::optional(bounce);
  };
  return balls;
}

WalkerState thrown(std::initializer_list<double> heights, double rate) {
  WalkerState state;
  state.q = VectorXd(static_cast<Eigen::Index>(heights.size()));
  std::copy(heights.begin(), heights.end(), state.q.begin());
  state.qd = VectorXd::Constant(state.q.size(), rate);
  return state;
}

TEST(Simulate, EventsAreLocatedToTheTolerance) {
  const Balls balls = bouncing(1);
  for (const double dt : {0.3, 1e-2, 1e-3}) {
    WalkerState state = thrown({0.5}, 0);
    std::vector<WalkerEvent> events;
    advance(balls, state, 1.5, {.max_step = dt}, events);
    ASSERT_EQ(events.size(), 1u);
    EXPECT_NEAR(events[0].time, 1, 2e-12);  // z = 1/2 - t^2/2
    EXPECT_NEAR(state.time, 1.5, 0);
    EXPECT_NEAR(state.q(0), 0.5 - 0.125, 1e-11);
  }
}

TEST(Simulate, SimultaneousEventsAllHappen) {
  const Balls balls = bouncing(1);
  WalkerState state = thrown({0.5, 0.5, 0.5}, 0);
  std::vector<WalkerEvent> events;
  advance(balls, state, 1.5, {}, events);
  ASSERT_EQ(events.size(), 3u);
  for (const WalkerEvent& event : events) EXPECT_NEAR(event.time, 1, 2e-12);
  for (const double z : state.q) EXPECT_NEAR(z, 0.375, 1e-10);
}

// A ceiling that is crossed twice within one step of 0.3 s.
TEST(Simulate, GrazingWithinOneStepIsSeen) {
  Balls balls = bouncing(1);
  const double top = 0.5;  // apex of a ball thrown at 1 from 0, at t = 1
  const auto hits = [&](double ceiling) {
    balls.guards_of = [ceiling](const WalkerState& state) {
      return std::vector<Guard>{{0, ceiling - state.q(0), -state.qd(0)}};
    };
    WalkerState state = thrown({0}, 1);
    std::vector<WalkerEvent> events;
    advance(balls, state, 1.8, {.max_step = 0.3}, events);
    return events;
  };
  EXPECT_TRUE(hits(top + 1e-6).empty());
  const auto touched = hits(top - 1e-4);
  ASSERT_EQ(touched.size(), 1u);
  EXPECT_NEAR(touched[0].time, 1 - std::sqrt(2e-4), 1e-9);
}

TEST(Simulate, CrossingsThatMeanNothingAreSkippedOnce) {
  Balls balls = bouncing(1);
  int asked = 0;
  balls.event_of = [&](int, const WalkerState&) {
    ++asked;
    return std::optional<Transition>();
  };
  WalkerState state = thrown({0.5}, 0);
  std::vector<WalkerEvent> events;
  advance(balls, state, 2, {}, events);
  EXPECT_EQ(asked, 1);
  EXPECT_TRUE(events.empty());
  EXPECT_NEAR(state.q(0), 0.5 - 2, 1e-10);
}

TEST(Simulate, EndlessBouncingIsReportedAsDiverged) {
  const Balls balls = bouncing(0.5);  // comes to rest after infinitely many bounces at t = 3
  WalkerState state = thrown({0.5}, 0);
  std::vector<WalkerEvent> events;
  EXPECT_FALSE(advance(balls, state, 10, {}, events));
  EXPECT_EQ(state.health, Health::kDiverged);
  EXPECT_LE(events.size(), 64u);
  EXPECT_TRUE(state.q.allFinite());
}

TEST(Simulate, DivergenceIsAStateWithTheLastSoundNumbers) {
  Balls balls = bouncing(1);
  balls.gravity = 1e12;
  WalkerState state = thrown({1e12}, 0);
  std::vector<WalkerEvent> events;
  EXPECT_FALSE(advance(balls, state, 10, {}, events));
  EXPECT_EQ(state.health, Health::kDiverged);
  EXPECT_TRUE(state.q.allFinite() && state.qd.allFinite());
}

TEST(Simulate, NoTimeIsNoStep) {
  const Balls balls = bouncing(1);
  WalkerState state = thrown({0.5}, 0);
  std::vector<WalkerEvent> events;
  EXPECT_FALSE(advance(balls, state, 0, {}, events));
  EXPECT_EQ(state.time, 0);
  EXPECT_FALSE(take_step(balls, state, {}, 5).has_value());  // bounces never complete a step
}

// A rebound far shorter than a step: up at 1e-5 m/s under g = 1, back after 2e-5 s.
TEST(Advance, LocatesTheEndOfATinyRebound) {
  for (const double rate : {1e-3, 1e-5, 1e-7}) {
    Balls balls = bouncing(0);
    const auto bounce = balls.event_of;
    balls.event_of = [&](int id, const WalkerState& state) {
      auto landed = bounce(id, state);
      landed->completes_step = true;
      return landed;
    };
    WalkerState state;
    state.q = VectorXd::Zero(1);
    state.qd = VectorXd::Constant(1, rate);
    std::vector<WalkerEvent> events;
    EXPECT_TRUE(advance(balls, state, 0.01, {}, events));
    EXPECT_NEAR(events.front().time, 2 * rate, 2e-12);
  }
}

}  // namespace
}  // namespace walktrack
