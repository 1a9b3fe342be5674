#include "jobs/sweep/sweep_grid.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/message_of.h"

namespace walktrack {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Scene scene_of(const std::vector<std::string>& cameras) {
  Scene scene;
  for (const std::string& name : cameras) {
    scene.cameras.emplace_back();
    scene.cameras.back().name = name;
  }
  return scene;
}

std::vector<SweptParameter> parameters_of(const std::vector<std::string>& words) {
  return swept_parameters(words, scene_of({"side", "front"}), {});
}

TEST(SweepParameters, AreReadFromWords) {
  const auto parameters =
      parameters_of({"particles=50:100,scale=60", "motion.residual_scale=0.5:1"});
  ASSERT_EQ(parameters.size(), 3u);
  EXPECT_EQ(parameters[0].name, "particles");
  EXPECT_THAT(parameters[0].values, ElementsAre("50", "100"));
  EXPECT_EQ(parameters[2].name, "motion.residual_scale");
  EXPECT_THAT(parameters_of({"model=markov:kneed"})[0].values, ElementsAre("markov", "kneed"));
  EXPECT_TRUE(parameters_of({}).empty());
}

struct Mistake {
  std::vector<std::string> words;
  std::string message;
};

TEST(SweepParameters, MistakesAreNamed) {
  const std::vector<Mistake> mistakes{
      {{"particles"}, "--over: found 'particles', allowed: NAME=VALUE:VALUE"},
      {{"particles="}, "NAME=VALUE"},
      {{"=3"}, "NAME=VALUE"},
      {{""}, "NAME=VALUE"},
      {{"particels=3"}, "found an unknown parameter, did you mean 'particles'?"},
      {{"step=3"}, "--over: step: found an unknown parameter"},
      {{"filter.particle=3"}, "did you mean 'filter.particles'?"},
      {{"path=flat"}, "motion.path: found 'flat', allowed: spatial, sagittal"},
      {{"model=legs"}, "motion.model: found 'legs', allowed: kneed, anthropomorphic, markov"},
      {{"particles=-1"}, "filter.particles: found '-1', allowed: a whole number from 0"},
      {{"particles=10::20"}, "filter.particles: found ''"},
      {{"particles=10:10"}, "particles: found '10', allowed: every value once"},
      {{"particles=10,filter.particles=20"}, "allowed: every parameter once"},
      {{"cameras=0"}, "cameras: found '0', allowed: 1 to 2, or names of side, front joined by +"},
      {{"cameras=3"}, "found '3'"},
      {{"cameras=1.5"}, "found '1.5'"},
      {{"cameras=side+back"}, "found 'side+back'"},
      {{"terms=colour"},
       "terms: found 'colour', allowed: all, or background, foreground, flow, keypoints"},
      {{"terms=all+flow"}, "found 'all+flow'"},
      {{"config=quick"}, "quick: found no such file, allowed: a file, or a preset: fast, balanced"},
  };
  for (const Mistake& mistake : mistakes)
    EXPECT_THAT(message_of<UsageError>([&] { parameters_of(mistake.words); }),
                HasSubstr(mistake.message));
}

TEST(SweepGrid, HasEveryCombinationOnce) {
  const auto grid = sweep_grid({{"a", {"1", "2"}}, {"b", {"x"}}, {"c", {"p", "q"}}});
  EXPECT_THAT(grid, ElementsAre(ElementsAre("1", "x", "p"), ElementsAre("1", "x", "q"),
                                ElementsAre("2", "x", "p"), ElementsAre("2", "x", "q")));
  EXPECT_THAT(sweep_grid({}), ElementsAre(SweepSetting{}));  // as configured
}

TEST(SweepGrid, RichestIsTheLargestOfEachParameterWhereverItStands) {
  EXPECT_THAT(richest_setting({{"particles", {"300", "1000", "75"}},
                               {"cameras", {"side", "side+front", "front"}},
                               {"terms", {"background+flow", "all", "flow"}},
                               {"arms", {"true", "false"}},
                               {"config", {"fast", "balanced"}}}),
              ElementsAre("1000", "side+front", "all", "true", "balanced"));
}

TEST(SweepSetting, SwitchesKeypoints) {
  Scene scene = scene_of({"side"});
  ConfigWithOrigin config;
  const std::vector<SweptParameter> parameters{{"keypoints", {"off", "on"}}};
  apply_sweep_setting(parameters, {"on"}, scene, config);
  EXPECT_EQ(config.values.observation.keypoints.enabled, TermSetting::kOn);
  apply_sweep_setting(parameters, {"off"}, scene, config);
  EXPECT_EQ(config.values.observation.keypoints.enabled, TermSetting::kOff);
  EXPECT_THAT(richest_setting(parameters), ElementsAre("on"));
}

TEST(SweepSetting, ReachesSceneAndConfiguration) {
  const std::vector<SweptParameter> parameters{{"particles", {"50"}},
                                               {"scale", {"80"}},
                                               {"terms", {"background+flow"}},
                                               {"cameras", {"front"}},
                                               {"arms", {"true"}}};
  Scene scene = scene_of({"side", "front"});
  ConfigWithOrigin config;
  apply_sweep_setting(parameters, {"50", "80", "background+flow", "front", "true"}, scene, config);
  EXPECT_EQ(config.values.tracker.filter.particles, 50);
  EXPECT_EQ(config.values.observation.person_px, 80);
  EXPECT_TRUE(config.values.observation.background.enabled);
  EXPECT_FALSE(config.values.observation.foreground.enabled);
  EXPECT_EQ(config.values.observation.flow.enabled, TermSetting::kOn);
  EXPECT_TRUE(config.values.body.arms);
  ASSERT_EQ(scene.cameras.size(), 1u);
  EXPECT_EQ(scene.cameras[0].name, "front");
  EXPECT_EQ(config.origin.at("filter.particles"), "--over");
}

TEST(SweepSetting, OtherParametersComeOnTopOfAConfigWhereverItStands) {
  const std::vector<SweptParameter> parameters{{"particles", {"7"}}, {"config", {"fast"}}};
  Scene scene = scene_of({"side"});
  ConfigWithOrigin config;
  apply_sweep_setting(parameters, {"7", "fast"}, scene, config);
  EXPECT_EQ(config.values.tracker.filter.particles, 7);
}

TEST(SweepSetting, IsCalledByItsParameters) {
  EXPECT_EQ(setting_name({{"particles", {"50"}}, {"arms", {"true"}}}, {"50", "true"}),
            "particles=50 arms=true");
}

}  // namespace
}  // namespace walktrack
