// The published gaits of the monopode: running and walking on a spring.
#include "walker/monopode.h"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "core/conventions.h"
#include "published_gait.h"

namespace walktrack {
namespace {

MonopodeParameters runner(double attack_deg) {
  MonopodeParameters p;
  p.attack = rad_from_deg(attack_deg);
  return p;
}

// The guess determines the energy (given with five digits), which Newton's method keeps.
GaitCycle running_at(const Monopode& walker, double apex) {
  return find_gait(walker, walker.apex(apex, 0, 1784.8).value()).value();
}

TEST(Published, MonopodeRunning) {
  const GaitCycle gait = running_at(Monopode(runner(68)), .95);
  expect_relative(gait.start.q(1), .940267, 1e-4);
  expect_relative(gait.start.qd(0), 5.11585, 1e-4);
  EXPECT_NEAR(gait.cycle.multipliers(0).real(), -.1613, 1e-4);
  const GaitCycle steeper = running_at(Monopode(runner(67)), .95);
  expect_relative(steeper.start.q(1), .959569, 1e-4);
  EXPECT_NEAR(steeper.cycle.multipliers(0).real(), .4414, 1e-4);
}

// Times of landings and take-offs, and the largest forces, along one step.
struct LegRecord {
  double peak = 0, peak_together = 0;  // N, vertical
  std::vector<double> landings, take_offs;
};

LegRecord leg_record(const Walker& walker, const WalkerState& start, int steps) {
  LegRecord record;
  WalkerState state = start;
  std::vector<WalkerEvent> events;
  for (int i = 0; i < steps; ++i) {
    advance(walker, state, 10, {}, events, [&](const WalkerState& now) {
      double together = 0;
      for (const ContactForce& contact : walker.contact_forces(now)) {
        record.peak = std::max(record.peak, contact.force.y());
        together += contact.force.y();
      }
      record.peak_together = std::max(record.peak_together, together);
    });
  }
  for (const WalkerEvent& event : events) {
    if (event.transition.kind == EventKind::kStrike) record.landings.push_back(event.time);
    if (event.transition.kind == EventKind::kTakeOff) record.take_offs.push_back(event.time);
  }
  return record;
}

TEST(Published, MonopodeRunningContact) {
  const Monopode walker(runner(68));
  const auto gait = find_gait(walker, *walker.apex(.9403, 0, 1784.8));
  ASSERT_TRUE(gait);
  const LegRecord legs = leg_record(walker, gait->start, 1);
  ASSERT_EQ(legs.landings.size(), 1u);
  expect_relative(legs.take_offs[0] - legs.landings[0], .14924, 1e-3);
  expect_relative(legs.peak / walker.weight(), 2.659, 1e-3);
}

TEST(Published, MonopodeWalking) {
  MonopodeParameters p;
  p.walks = true;
  p.attack = rad_from_deg(69);
  p.stiffness = 17.8 * p.mass * p.gravity / p.leg_length;
  const Monopode walker(p);
  const double energy = 1.04 * walker.weight() * p.leg_length;
  const auto gait = find_gait(walker, *walker.apex(.9712, 0, energy));
  ASSERT_TRUE(gait);
  expect_relative(gait->start.q(1), .971160, 1e-3);
  expect_relative(gait->start.qd(0), 1.09791, 1e-3);
  expect_relative(gait->step.period, .44402, 1e-3);
  expect_relative(gait->step.step_length, .51384, 1e-3);
  expect_relative(gait->speed, 1.15724, 1e-3);
  expect_multipliers(*gait, {{.8050, .5463}, {.8050, -.5463}});
  const LegRecord legs = leg_record(walker, gait->start, 2);
  expect_relative(legs.take_offs[0] - legs.landings[0], .16690, 1e-3);
  expect_relative(legs.peak / walker.weight(), 1.0497, 1e-3);
  expect_relative(legs.peak_together / walker.weight(), 1.873, 1e-3);
}

}  // namespace
}  // namespace walktrack
