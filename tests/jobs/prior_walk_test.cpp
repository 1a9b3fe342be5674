#include "jobs/prior_walk.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "core/errors.h"

namespace walktrack {
namespace {

Recording walked(const WalkPlan& walk, double seconds, double slope = 0) {
  SimulateJob job;
  job.model = default_model("kneed");
  job.model.kneed.slope = slope;
  job.duration = seconds;
  job.simulation.max_step = 4e-3;  // people's knees need no finer one
  job = with_prior(job, walk);
  return record(*make_walker(job.model), job, {});
}

// Speeds of the body, step by step.
std::vector<double> speeds(const Recording& recording) {
  std::vector<double> result;
  double last = 0;
  for (const WalkerEvent& event : recording.events) {
    if (!event.transition.completes_step) continue;
    result.push_back(event.transition.advance / (event.time - last));
    last = event.time;
  }
  return result;
}

TEST(PriorWalk, WalksAtTheSpeedAskedFor) {
  for (const double speed : {0.8, 1.3, 1.8}) {
    const Recording recording = walked({.speed = speed, .changes = {}}, 10);
    EXPECT_EQ(recording.end.health, Health::kSound) << speed;
    // Between nodes the gait is interpolated: a few percent from an exact cycle.
    EXPECT_NEAR(speeds(recording).back(), speed, 0.05 * speed);
  }
}

TEST(PriorWalk, WalksUpAndDown) {
  for (const double slope : {-0.06, 0.06}) {
    EXPECT_EQ(walked({.speed = 1.3, .changes = {}}, 10, slope).end.health, Health::kSound) << slope;
  }
}

TEST(PriorWalk, ChangesSpeedOnTheWayWithoutFalling) {
  const Recording recording = walked({.speed = 0.9, .changes = {{3, 1.7}, {9, 1.0}}}, 15);
  EXPECT_EQ(recording.end.health, Health::kSound);
  const std::vector<double> all = speeds(recording);
  EXPECT_NEAR(all[2], 0.9, 0.06);
  EXPECT_NEAR(*std::max_element(all.begin(), all.end()), 1.7, 0.12);
  EXPECT_NEAR(all.back(), 1.0, 0.08);
  EXPECT_EQ(recording.changes.size(), static_cast<size_t>(recording.steps));
}

TEST(PriorWalk, IsForTheKneedWalkerAlone) {
  SimulateJob job;
  job.model = default_model("anthropomorphic");
  EXPECT_THROW(with_prior(job, {}), UsageError);
}

}  // namespace
}  // namespace walktrack
