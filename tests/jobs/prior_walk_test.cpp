#include "jobs/prior/prior_walk.h"

#include <algorithm>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/errors.h"
#include "io/scene/model_file.h"
#include "tests/message_of.h"

namespace walktrack {
namespace {

Recording walked(const WalkPlan& walk, double seconds, double slope = 0) {
  SimulateJob job;
  job.model = default_model("kneed");
  job.model.kneed.slope = slope;
  job.duration = seconds;
  job.simulation.max_step = 4e-3;  // people's knees need no smaller step
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
  const Recording recording = walked({.speed = 0.9, .changes = {{3, 1.7}, {9, 1.0}}}, 25);
  EXPECT_EQ(recording.end.health, Health::kSound);
  const std::vector<double> all = speeds(recording);
  EXPECT_NEAR(all[2], 0.9, 0.06);
  EXPECT_NEAR(*std::max_element(all.begin(), all.end()), 1.7, 0.12);
  EXPECT_NEAR(all.back(), 1.0, 0.08);
  EXPECT_EQ(recording.changes.size(), static_cast<size_t>(recording.steps));
}

TEST(PriorWalk, SlowsDownWithoutFalling) {
  for (const auto& [from, to] : {std::pair{1.3, 0.7}, {1.3, 0.9}, {2.0, 0.6}}) {
    const Recording recording = walked({.speed = from, .changes = {{2, to}}}, 30);
    EXPECT_EQ(recording.end.health, Health::kSound) << from << " to " << to;
    EXPECT_NEAR(speeds(recording).back(), to, 0.05 * to);
  }
}

TEST(PriorWalk, SpeedsThatTheTableDoesNotHoldAreErrors) {
  const auto message = [](const WalkPlan& plan) {
    SimulateJob job;
    job.model = default_model("kneed");
    return message_of<UsageError>([&] { with_prior(job, plan); });
  };
  EXPECT_THAT(message({.speed = 0.1, .changes = {}}),
              testing::AllOf(testing::HasSubstr("0.1 m/s"), testing::HasSubstr("0.50 to 2.20")));
  EXPECT_THAT(message({.speed = 1.3, .changes = {{2, 3.5}}}), testing::HasSubstr("3.5 m/s"));
}

SimulateJob adult_legs(double slope = 0) {
  SimulateJob job;
  const std::string name = WALKTRACK_SOURCE_DIR "/configs/models/anthropomorphic_adult.yaml";
  job.model = read_model("", name, {});
  job.model.anthropomorphic.slope = slope;
  job.simulation.max_step = 4e-3;
  return job;
}

TEST(PriorWalk, AnthropomorphicWalkerWalksAndSlowsDown) {
  SimulateJob job = adult_legs();
  job.duration = 20;
  job = with_prior(job, {.speed = 1.8, .changes = {{3, 1.2}}});
  const Recording recording = record(*make_walker(job.model), job, {});
  EXPECT_EQ(recording.end.health, Health::kSound);
  EXPECT_NEAR(speeds(recording)[2], 1.8, 0.1);
  EXPECT_NEAR(speeds(recording).back(), 1.2, 0.06);
}

TEST(PriorWalk, AnthropomorphicWalkerWalksDownButNotUpNorSlowlyDown) {
  SimulateJob down = adult_legs(0.05);
  down.duration = 8;
  down = with_prior(down, {.speed = 1.5, .changes = {}});
  EXPECT_EQ(record(*make_walker(down.model), down, {}).end.health, Health::kSound);
  const auto message = [](double slope, double speed) {
    return message_of<UsageError>(
        [&] { with_prior(adult_legs(slope), {.speed = speed, .changes = {}}); });
  };
  EXPECT_THAT(message(-0.05, 1.3), testing::HasSubstr("downhill"));
  EXPECT_THAT(message(0.05, 0.7), testing::HasSubstr("brake"));
  EXPECT_THAT(message(0, 3), testing::HasSubstr("legs of 0.927 m"));
}

TEST(PriorWalk, IsForWalkersWithATable) {
  SimulateJob job;
  job.model = default_model("rimless_wheel");
  EXPECT_THROW(with_prior(job, {}), UsageError);
}

TEST(PriorWalk, RefusesWhatTheTableWouldReplace) {
  const auto message = [](double slope, double step_length) {
    SimulateJob job;
    job.model = default_model("kneed");
    job.model.kneed.slope = slope;
    WalkPlan plan;
    plan.step_length = step_length;
    return message_of<UsageError>([&] { with_prior(job, plan); });
  };
  EXPECT_EQ(message(0.08, 0), "");
  EXPECT_EQ(message(0, 0.7), "");
  EXPECT_THAT(message(0.2, 0), testing::HasSubstr("found 0.2 rad of slope"));
  EXPECT_THAT(message(0, 0.35), testing::HasSubstr("found 0.35 m at 1.3 m/s"));
}

}  // namespace
}  // namespace walktrack
