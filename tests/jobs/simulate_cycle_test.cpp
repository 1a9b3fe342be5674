#include "jobs/simulate/simulate_cycle.h"

#include <stdexcept>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/conventions.h"
#include "core/errors.h"
#include "io/scene/model_file.h"

namespace walktrack {
namespace {

CycleJob garcia(const char* slope) {
  CycleJob job;
  job.model = read_model(
      "", std::string(WALKTRACK_SOURCE_DIR) + "/configs/models/garcia_" + slope + ".yaml", {});
  job.options.simulation.max_step = 4e-3;
  return job;
}

TEST(CycleJob, JsonHoldsTheFixedPointAndMultipliers) {
  const FoundCycle found = find_cycle(garcia("009"));
  const auto json = nlohmann::json::parse(cycle_json(found));
  EXPECT_NEAR(json["q"][1].get<double>(), .200310901, 2e-7);
  EXPECT_NEAR(json["period"].get<double>(), 3.8824638, 4e-6);
  EXPECT_NEAR(json["multipliers"][0]["re"].get<double>(), -.19010, 1e-3);
  EXPECT_TRUE(json["stable"].get<bool>());
  EXPECT_NE(cycle_text(found).find("stable limit cycle"), std::string::npos);
}

// theta* grows as slope^(1/3): followed from .009 to .004 the cycle is the published one.
TEST(CycleJob, FollowsAParameter) {
  CycleJob job = garcia("009");
  job.follow_key = "slope";
  job.follow_to = .004;
  const FoundCycle found = find_cycle(job);
  EXPECT_NEAR(found.gait.start.q(1), .153389565, 2e-7);
  EXPECT_EQ(found.model.anthropomorphic.slope, .004);
  EXPECT_NEAR(found.model.start.q[1], .153389565, 2e-7);
  EXPECT_TRUE(nlohmann::json::parse(cycle_json(found))["branch_changes"].empty());
  FoundCycle jumped = found;
  jumped.branch_changes = {{.006, .005}};
  EXPECT_EQ(nlohmann::json::parse(cycle_json(jumped))["branch_changes"][0]["to"], .005);
  EXPECT_NE(cycle_text(jumped).find("between slope = 0.006 and 0.005"), std::string::npos);
}

// A monopode with a stated energy keeps it during the continuation, for any stiffness.
TEST(CycleJob, FollowsAtTheEnergyOfTheModel) {
  CycleJob job;
  job.model = read_model(
      "", std::string(WALKTRACK_SOURCE_DIR) + "/configs/models/monopode_walking.yaml", {});
  job.follow_key = "stiffness";
  job.follow_to = 15000;
  const FoundCycle followed = find_cycle(job);
  const auto walker = make_walker(followed.model);
  EXPECT_NEAR(walker->energy(followed.gait.start).total(), 816.192, 1e-9 * 816);
  EXPECT_TRUE(followed.branch_changes.empty());
  CycleJob direct = job;
  direct.follow_key.clear();
  direct.model.monopode.stiffness = 15000;
  EXPECT_LT((find_cycle(direct).gait.start.q - followed.gait.start.q).norm(), 1e-5);
}

// For any guess, the cycle has the energy that was stated.
TEST(CycleJob, MonopodesKeepTheirEnergyFromEveryGuess) {
  std::vector<FoundCycle> found;
  for (const double apex : {.960, .965, .970, .975, .980, .985}) {
    CycleJob job;
    job.model = read_model(
        "", std::string(WALKTRACK_SOURCE_DIR) + "/configs/models/monopode_walking.yaml", {});
    job.model.start.energy = 820;
    job.model.start.q[1] = apex;
    found.push_back(find_cycle(job));
    EXPECT_NEAR(found.back().energy, 820, 1e-9 * 820) << apex;
    EXPECT_LT((found.back().gait.start.q - found[0].gait.start.q).norm(), 1e-8) << apex;
    EXPECT_NE(cycle_json(found.back()).find("\"energy\": 820.0"), std::string::npos);
  }
  // Without a stated energy it is the guess's own.
  CycleJob job;
  job.model = found[0].model;
  job.model.start.energy = 0;
  job.model.start.q[1] += 1e-3;
  const auto walker = make_walker(job.model);
  const Eigen::VectorXd guess = start_point(job.model, *walker);
  const double energy = walker->energy(walker->section_state(guess.head(2), guess.tail(2))).total();
  EXPECT_NEAR(find_cycle(job).energy, energy, 1e-9 * energy);
}

// Gaits with a flight phase: landing on the other foot (running) and on the same one (leaping). The
// ground never pulls.
TEST(CycleJob, KneedWalkersRunAndLeap) {
  const auto flies = [](const std::string& name, size_t strikes, double multiplier) {
    CycleJob job;
    job.model = read_model(
        "", std::string(WALKTRACK_SOURCE_DIR) + "/configs/models/kneed_" + name + ".yaml", {});
    const FoundCycle found = find_cycle(job);
    EXPECT_LT(found.gait.cycle.residual, 1e-10);
    EXPECT_NEAR(found.gait.cycle.largest_multiplier(), multiplier, 2e-3);
    EXPECT_GT(found.gait.step.lowest_normal, -1e-6 * found.weight);
    size_t landed = 0, left = 0;
    for (const WalkerEvent& event : found.gait.step.events) {
      landed += event.transition.kind == EventKind::kStrike ? 1 : 0;
      left += event.transition.kind == EventKind::kTakeOff ? 1 : 0;
    }
    EXPECT_EQ(left, 1u) << name;
    EXPECT_EQ(landed, strikes) << name;
  };
  flies("running", 1, 1.1365);
  flies("leaping", 2, .9236);
}

// Steeper runners have no cycle at this energy: two meet between 66 and 67 degrees.
TEST(CycleJob, SaysHowFarItFollowed) {
  CycleJob job;
  job.model = default_model("monopode");
  job.follow_key = "parameters.attack";
  job.follow_to = rad_from_deg(64);
  try {
    find_cycle(job);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("parameters.attack = 1.15"), std::string::npos)
        << error.what();
  }
}

TEST(CycleJob, SaysWhatHappensWhereThereIsNoCycle) {
  CycleJob job = garcia("009");
  job.model.anthropomorphic.slope = 0.3;
  try {
    find_cycle(job);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("falls after"), std::string::npos) << error.what();
  }
  job = garcia("009");
  job.follow_key = "slop";
  EXPECT_THROW(find_cycle(job), UsageError);
}

TEST(CycleJob, SettlingWalksTheGuessIn) {
  CycleJob job = garcia("004");
  for (double& rate : job.model.start.qd) rate *= 1.02;
  job.settling_steps = 5;
  EXPECT_NEAR(find_cycle(job).gait.start.q(1), .153389565, 2e-7);
}

}  // namespace
}  // namespace walktrack
