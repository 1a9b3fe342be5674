#include "jobs/plan/plan.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <nlohmann/json.hpp>

#include "core/conventions.h"
#include "jobs/plan/plan_text.h"
#include "tests/message_of.h"

namespace walktrack {
namespace {

using testing::HasSubstr;
using testing::Not;

Scene demo() { return read_scene(WALKTRACK_SOURCE_DIR "/data/demo/scene.yaml"); }

Plan plan_with(const std::vector<std::string>& settings, Scene scene = demo()) {
  ConfigWithOrigin config;
  for (const std::string& setting : settings) apply_setting(config, setting, "--set");
  return plan_scene(scene, config);
}

double ms_with(const std::vector<std::string>& settings) { return plan_with(settings).cost.sum(); }

const PlanItem& item(const Plan& plan, const std::string& name) {
  for (const PlanItem& each : plan.items)
    if (each.name == name) return each;
  throw InputError(name);
}

double first_camera_ms(const Plan& plan, std::string_view what) {
  double sum = 0;
  for (const auto& [each, ms] : plan.cost.cameras[0])
    if (each == what) sum += ms;
  return sum;
}

std::string advice(const Plan& plan) {
  std::string text;
  for (const std::string& sentence : plan.advice) text += sentence + "\n";
  return text;
}

TEST(Plan, SharesOfTimeAreAllOfIt) {
  const Plan plan = plan_with({});
  double cameras = 0, stages = 0;
  for (const PlanCamera& camera : plan.cameras) cameras += camera.ms;
  EXPECT_NEAR(cameras + plan.cost.walker + plan.cost.poses, plan.cost.sum(), 1e-9);
  const auto json = nlohmann::json::parse(plan_json(plan));
  for (const auto& [stage, ms] : json.at("cpu_ms_by_stage").items()) stages += ms.get<double>();
  EXPECT_NEAR(stages, plan.cost.sum(), 1e-9);
}

TEST(Plan, WhatIsOffCostsNothingAndIsNoCost) {
  const Plan plan = plan_with({"observation.foreground.enabled=false"});
  for (const char* name : {"flow", "arms", "appearance", "slope", "occluders"}) {
    EXPECT_FALSE(item(plan, name).on) << name;
    EXPECT_EQ(item(plan, name).ms, 0) << name;
  }
  for (const Costs& camera : plan.cost.cameras) {
    for (const auto& [what, ms] : camera) {
      EXPECT_NE(what, "flow");
      EXPECT_NE(what, "appearance");
    }
  }
  EXPECT_THAT(plan_text(plan), Not(HasSubstr("  flow         ")));
  EXPECT_THAT(plan_text(plan), HasSubstr("off flow"));
}

// The stated saving of an item is the difference between the plans with and without it.
TEST(Plan, SavingsAreDifferencesOfPlans) {
  const Plan all = plan_with({"body.arms=true", "observation.flow.enabled=true"});
  EXPECT_NEAR(item(all, "flow").ms, all.cost.sum() - ms_with({"body.arms=true"}), 1e-9);
  EXPECT_NEAR(item(all, "arms").ms, all.cost.sum() - ms_with({"observation.flow.enabled=true"}),
              1e-9);
  EXPECT_GT(item(all, "flow").ms, 0);
  EXPECT_GT(item(all, "arms").ms, 0);
  EXPECT_GT(item(all, "head").ms, 0);
}

// The structure of the model: the particles' work is proportional to their number, the images' work
// does not depend on it, and in a frame shrunk to half its side the evidence costs a quarter.
TEST(CostModel, HasTheShapeOfTheWork) {
  const double none = ms_with({"filter.particles=1"}), some = ms_with({"filter.particles=101"});
  EXPECT_NEAR(ms_with({"filter.particles=1001"}) - none, 10 * (some - none), 1e-6);
  const Plan one = plan_with({"filter.moves=1"}), three = plan_with({"filter.moves=3"});
  EXPECT_EQ(one.cost.walker, three.cost.walker);
  EXPECT_GT(three.cost.poses, 2 * one.cost.poses);
  EXPECT_EQ(first_camera_ms(one, "background"), first_camera_ms(three, "background"));
  const Plan large = plan_with({"observation.person_px=240"}),
             small = plan_with({"observation.person_px=120"});
  ASSERT_EQ(large.cameras[0].shrink, 1);
  ASSERT_EQ(small.cameras[0].shrink, 2);
  EXPECT_NEAR(large.work.cameras[0].rows, 2 * small.work.cameras[0].rows, 1e-9);
  EXPECT_EQ(first_camera_ms(large, "decoding"), first_camera_ms(small, "decoding"));
  EXPECT_GT(first_camera_ms(large, "background"), 2 * first_camera_ms(small, "background"));
  EXPECT_LE(first_camera_ms(large, "background"), 4 * first_camera_ms(small, "background") + 1e-9);
  Scene one_camera = demo();
  one_camera.cameras.resize(1);
  // It would be asked for keypoints otherwise.
  const std::string no_points = "observation.keypoints.enabled=off";
  const Plan alone = plan_with({no_points, "motion.turning_yaw_rate_sd=0"}, one_camera);
  EXPECT_LT(alone.cost.sum(), plan_with({}).cost.sum());
  EXPECT_EQ(alone.cost.walker, plan_with({}).cost.walker);
  // With two components that turn, which make half of the moves.
  const Plan turning = plan_with({no_points}, one_camera);
  EXPECT_NEAR(turning.cost.walker, 3 * alone.cost.walker, 1e-9);
  EXPECT_GT(turning.cost.poses, 1.9 * alone.cost.poses);
  EXPECT_LT(turning.cost.poses, 2.2 * alone.cost.poses);
}

TEST(Plan, SaysWhereEachChoiceComesFrom) {
  const Plan plan = plan_with({"body.arms=true"});
  EXPECT_EQ(item(plan, "arms").why, "body.arms, from --set");
  EXPECT_EQ(item(plan, "head").why, "body.head, a default");
  EXPECT_THAT(item(plan, "search").why, HasSubstr("no `initial`"));
}

TEST(Plan, CountsTheState) {
  const Plan without = plan_with({}), with = plan_with({"body.arms=true"});
  EXPECT_EQ(with.state.dimension() - without.state.dimension(), 12);  // 6 angles and their rates
  EXPECT_EQ(with.state.noise - without.state.noise, 6);
  EXPECT_GE(without.state.bytes_per_particle, 8.0 * without.state.dimension());
}

// A state has the numbers of its level, and each level includes all of the one before.
TEST(PlanLevels, EachAddsToTheLast) {
  const Plan plan = plan_with({});
  const auto& levels = plan.levels.levels;
  ASSERT_EQ(levels.size(), 3);
  EXPECT_EQ(levels[1].state.noise - levels[0].state.noise, 6);
  EXPECT_EQ(levels[1].state.dimension() - levels[0].state.dimension(), 13)
      << "6 angles with their rates; the way instead of the heading";
  EXPECT_EQ(levels[2].state.noise - levels[1].state.noise, 6);
  EXPECT_FALSE(levels[0].on);
  EXPECT_TRUE(levels[1].on);
  EXPECT_EQ(levels[1].state.dimension(), plan.state.dimension());
  const Plan low = plan_with({"motion.path=sagittal"});
  EXPECT_TRUE(low.levels.levels[0].on);
  EXPECT_EQ(low.state.dimension(), levels[0].state.dimension());
  EXPECT_FALSE(item(low, "sideways").on);
  const Plan low_arms = plan_with({"motion.path=sagittal", "body.arms=true"});
  EXPECT_TRUE(low_arms.levels.levels[2].on);
  EXPECT_EQ(low_arms.state.noise, low.state.noise + 4) << "arms swing, and do not spread";
  const auto json = nlohmann::json::parse(plan_json(low));
  EXPECT_EQ(json.at("levels").at(1).at("lowest_sufficient"), true);
  EXPECT_EQ(json.at("lowest_level_why"), low.levels.why);
}

struct SeenFrom {
  const char* name;
  Eigen::Vector2d position;  // of the walker, m; the demo's first camera sees it along +y, 6 m off
  double heading_deg;
  bool side_view;
};

Scene one_camera_at(const SeenFrom& seen) {
  Scene scene = demo();
  scene.cameras.resize(1);
  scene.initial = InitialState{0, seen.position, rad_from_deg(seen.heading_deg), {}, {}};
  return scene;
}

TEST(PlanLevels, ASideViewOfOneCameraNeedsTheSagittalPathAlone) {
  for (const SeenFrom& seen :
       {SeenFrom{"across", {0, 0}, 0, true}, SeenFrom{"back across", {0, 0}, 180, true},
        SeenFrom{"a little oblique", {0, 0}, 20, true}, SeenFrom{"oblique", {0, 0}, 40, false},
        SeenFrom{"away", {0, 0}, 90, false}}) {
    const Plan plan = plan_with({}, one_camera_at(seen));
    EXPECT_EQ(plan.levels.levels[0].lowest, seen.side_view) << seen.name << plan.levels.why;
    EXPECT_EQ(plan.levels.levels[1].lowest, !seen.side_view) << seen.name;
  }
}

TEST(PlanLevels, SayWhyTheSagittalPathIsNotEnough) {
  Scene scene = demo();
  scene.initial = InitialState{0, {0, 0}, 0, {}, {}};
  EXPECT_THAT(plan_with({}, scene).levels.why, HasSubstr("several cameras"));
  scene.cameras.resize(1);
  scene.initial.reset();
  scene.initial = InitialState{0, {0, 0}, 0.5 * kPi, {}, {}};
  EXPECT_THAT(plan_with({}, scene).levels.why, HasSubstr("0 degrees off the camera's line"));
  scene.initial = InitialState{0, {0, 0}, 0, {}, {}};
  Camera& camera = scene.cameras[0].camera;
  camera.translation -= camera.rotation * Eigen::Vector3d(0, 0, 4);
  EXPECT_THAT(plan_with({}, scene).levels.why, HasSubstr("degrees above the horizon"));
}

// Only the camera shows how the walk is seen: level cameras are usually set up for walks across.
TEST(PlanLevels, WithoutABeginningALevelCameraIsTakenToSeeTheWalkFromTheSide) {
  Scene scene = demo();
  scene.cameras.resize(1);
  scene.initial.reset();
  const Plan level = plan_with({}, scene);
  EXPECT_TRUE(level.levels.levels[0].lowest) << level.levels.why;
  EXPECT_FALSE(level.levels.levels[1].lowest);
  EXPECT_THAT(level.levels.why, HasSubstr("no `initial`"));
  Camera& camera = scene.cameras[0].camera;
  const double down = rad_from_deg(40);
  const Eigen::Matrix3d tilt = Eigen::AngleAxisd(down, Eigen::Vector3d::UnitX()).toRotationMatrix();
  camera.rotation = (tilt * camera.rotation).eval();
  const Plan steep = plan_with({}, scene);
  EXPECT_TRUE(steep.levels.levels[1].lowest) << steep.levels.why;
  EXPECT_THAT(steep.levels.why, testing::ContainsRegex("looks [0-9]+ degrees (down|up)"));
}

TEST(PlanLevels, NameTheirProof) {
  const std::string text = plan_text(plan_with({}));
  EXPECT_THAT(text, HasSubstr("walktrack sweep"));
  EXPECT_THAT(text, HasSubstr("--over path=sagittal:spatial"));
  EXPECT_THAT(text, HasSubstr("<- on, and suffices"));
}

TEST(Plan, AdvisesWhatASceneDoesNotNeed) {
  const std::string much = advice(
      plan_with({"body.arms=true", "observation.flow.enabled=true", "observation.person_px=300",
                 "filter.particles=2000", "motion.path=sagittal"}));
  for (const char* word : {"Flow:", "Arms:", "Scale:", "Particles:", "Cameras:"})
    EXPECT_THAT(much, HasSubstr(word));
  Scene one_camera = demo();
  one_camera.cameras.resize(1);
  const Plan lean = plan_with({}, one_camera);
  EXPECT_TRUE(lean.advice.empty()) << advice(lean);
  EXPECT_THAT(plan_text(lean), HasSubstr("Nothing in this model seems to be more"));
  // Flow that is the only term is not superfluous.
  const Plan flow =
      plan_with({"observation.background.enabled=false", "observation.foreground.enabled=false",
                 "observation.flow.enabled=true"},
                one_camera);
  EXPECT_THAT(advice(flow), Not(HasSubstr("Flow:")));
}

// Outlines from two sides distinguish left from right; the network costs as much as its runs.
TEST(Plan, SaysWhenTheNetworkIsNotNeededAndWhatItCosts) {
  const std::string on = "observation.keypoints.enabled=on";
  EXPECT_THAT(advice(plan_with({on})), HasSubstr("Keypoints: with 2 cameras silhouettes alone"));
  EXPECT_THAT(advice(plan_with({})), Not(HasSubstr("Keypoints:")));
  const double none = ms_with({}), third = ms_with({on}) - none,
               each = ms_with({on, "observation.keypoints.every=1"}) - none;
  EXPECT_GT(third, 0);
  constexpr double kLook = 14;  // ms (data/pose_net/README.md)
  EXPECT_NEAR(each - third, 2 * (1 - 1.0 / 3) * kLook, 5);
}

// If the direction of the walk is known, the camera at the side is the one to keep; not where a
// track before it alone takes longer, because it has to be compared with those of subjects who
// turn.
TEST(Plan, KnowsTheCameraAtTheSide) {
  Scene scene = demo();
  scene.initial = InitialState{0, {0, 0}, 0, std::nullopt, std::nullopt};  // along x
  EXPECT_THAT(advice(plan_with({"motion.path=sagittal"}, scene)), HasSubstr("(side)"));
  EXPECT_THAT(advice(plan_with({}, scene)), Not(HasSubstr("Cameras:")));
  EXPECT_FALSE(item(plan_with({}, scene), "search").on);
}

TEST(Plan, TheSizeIsLookedForWhereTheSceneDoesNotGiveIt) {
  Scene scene = demo();
  EXPECT_FALSE(item(plan_with({}, scene), "size").on);
  scene.height_given = false;
  EXPECT_TRUE(item(plan_with({}, scene), "size").on);
  EXPECT_EQ(item(plan_with({}, scene), "size").why, "the scene does not give subject.height");
}

TEST(Plan, GirthAndTrunkAreEstimatedBeforeOneCameraUnlessTheyAreGiven) {
  Scene scene = demo();
  for (const char* name : {"girth", "trunk"})
    EXPECT_EQ(item(plan_with({}, scene), name).why, "only for one camera with a video") << name;
  scene.cameras.resize(1);
  EXPECT_TRUE(item(plan_with({}, scene), "girth").on);
  EXPECT_TRUE(item(plan_with({}, scene), "trunk").on);
  scene.height_given = false;
  EXPECT_TRUE(item(plan_with({}, scene), "girth").on);
  EXPECT_EQ(item(plan_with({}, scene), "trunk").why, "the scene does not give subject.height");
  scene.girth_given = true;
  scene.subject.lengths.trunk = 0.45;
  EXPECT_EQ(item(plan_with({}, scene), "girth").why, "the scene gives subject.girth");
  EXPECT_EQ(item(plan_with({}, scene), "trunk").why, "the scene gives subject.lengths.trunk");
}

TEST(Plan, TheLagOfTwoCamerasIsLookedForWhereTheSceneDoesNotGiveIt) {
  Scene scene = demo();
  ASSERT_EQ(scene.cameras.size(), 2u);
  for (SceneCamera& camera : scene.cameras) camera.start_given = false;
  EXPECT_TRUE(item(plan_with({}, scene), "lag").on);
  scene.cameras[1].start_given = true;
  EXPECT_EQ(item(plan_with({}, scene), "lag").why, "the scene gives a start_frame");
  scene.cameras.pop_back();
  EXPECT_EQ(item(plan_with({}, scene), "lag").why, "only for two cameras");
}

TEST(Plan, ASlopeIsOnWhereGravityLeans) {
  Scene scene = demo();
  scene.gravity = {-9.8 * std::sin(0.1), 0, -9.8 * std::cos(0.1)};
  EXPECT_TRUE(item(plan_with({}, scene), "slope").on);
  EXPECT_EQ(item(plan_with({}, scene), "slope").what, "5.7 degrees");
}

}  // namespace
}  // namespace walktrack
