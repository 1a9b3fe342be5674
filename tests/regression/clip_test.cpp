#include "tests/regression/clip.h"

#include <cmath>
#include <functional>
#include <map>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/archive/files.h"
#include "tests/body/changed_motion.h"
#include "tests/regression/compared.h"
#include "tests/run_program.h"

namespace walktrack {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kRate = 50;  // Hz
constexpr double kFootsBreadth = 0.2;

// Feet that stand beside each other at x = 1 m, the left one at y = 0.2, for half a second.
Motion standing_feet() {
  Motion out;
  for (int i = 0; i < 25; ++i) {
    out.time.push_back(i / kRate);
    out.joints.push_back(unknown_joints());
    out.joints.back()[toe(Side::kLeft)] = Vector3d(1, kFootsBreadth, 0);
    out.joints.back()[toe(Side::kRight)] = Vector3d(1, 0, 0);
  }
  return out;
}

ClipFacts facts_with(std::vector<Landing> landings) {
  ClipFacts out;
  out.landings = std::move(landings);
  out.run.rate = kRate;
  return out;
}

TEST(ClipFigures, AToeIsOffByItsDistanceAndOnItsSideIfItIsTheNearerOne) {
  const ClipFacts facts = facts_with({{Side::kLeft, 0, {1.03, kFootsBreadth}}});
  FigureValues found = clip_figures(facts, standing_feet());
  EXPECT_EQ(found["toes_on_side"], 1);
  EXPECT_NEAR(found["toe_error_mean_mm"], 30, 1e-6);
  const auto mirrored = [](JointPositions& joints, size_t) { mirror_legs(joints); };
  found = clip_figures(facts, changed(standing_feet(), mirrored));
  EXPECT_EQ(found["toes_on_side"], 0);
  EXPECT_GT(found["toe_error_mean_mm"], 1000 * kFootsBreadth);
}

// Frames 6 to 13 after it landed count, and of those the known ones.
TEST(ClipFigures, AToeIsMeasuredOnceItHasSettled) {
  const ClipFacts facts = facts_with({{Side::kRight, 3 / kRate, {1, 0}}});
  const auto moved = [](size_t first, size_t last) {
    return changed(standing_feet(), [=](JointPositions& joints, size_t row) {
      if (row >= first && row <= last) joints[toe(Side::kRight)].x() += 0.08;
    });
  };
  EXPECT_NEAR(clip_figures(facts, moved(0, 8))["toe_error_mean_mm"], 0, 1e-6);
  EXPECT_NEAR(clip_figures(facts, moved(17, 24))["toe_error_mean_mm"], 0, 1e-6);
  EXPECT_NEAR(clip_figures(facts, moved(9, 9))["toe_error_mean_mm"], 10, 1e-6);
  EXPECT_NEAR(clip_figures(facts, moved(16, 16))["toe_error_mean_mm"], 10, 1e-6);
  const auto lost = [](JointPositions& joints, size_t row) {
    if (row > 9) joints = unknown_joints();
  };
  EXPECT_NEAR(clip_figures(facts, changed(moved(9, 9), lost))["toe_error_mean_mm"], 80, 1e-6);
}

TEST(ClipFigures, ToesThatWereNeverTrackedAreOnNoSide) {
  const auto lost = [](JointPositions& joints, size_t) { joints = unknown_joints(); };
  FigureValues found =
      clip_figures(facts_with({{Side::kRight, 0, {1, 0}}}), changed(standing_feet(), lost));
  EXPECT_EQ(found["toes_on_side"], 0);
  EXPECT_TRUE(std::isnan(found["toe_error_mean_mm"]));
}

TEST(ClipFigures, StandingIsThatBeforeSettingOff) {
  ClipFacts facts = facts_with({});
  facts.sets_off = 4 / kRate;
  facts.stands_again = 20 / kRate;
  facts.run.standing = {1, 0.9, 0.2, NAN, 0, 0, 0};
  EXPECT_EQ(clip_figures(facts, standing_feet())["standing_percent"], 50);
}

TEST(ClipFigures, NobodyWhoWalksIsAnInvention) {
  ClipFacts facts;
  facts.walks = false;
  facts.run.steps = 3;
  facts.run.passed = true;
  FigureValues found = clip_figures(facts, standing_feet());
  EXPECT_EQ(found["invented_steps"], 3);
  EXPECT_EQ(found["invented_walks"], 1);
}

TEST(ClipFigures, LandingsBeforeAPartAreLeftOut) {
  const TemporaryFolder folder;
  write_file_atomically(folder.path() / "toe_plants.csv",
                        "side,on_frame,toe_x_m,toe_y_m\nright,0,-1.5,0\nleft,145,-1,0.1\n");
  const auto found = read_landings(folder.path() / "toe_plants.csv", 95, kRate);
  ASSERT_EQ(found.size(), 1);
  EXPECT_EQ(found[0].side, Side::kLeft);
  EXPECT_NEAR(found[0].time, 1, 1e-9);
  EXPECT_EQ(found[0].place, Vector2d(-1, 0.1));
}

// Would it be noticed? Faults planted into the results of real clips.
class RealClips : public testing::Test {
 protected:
  using Fault = std::function<void(SuiteResult&)>;
  static std::vector<std::string> noticed(const std::string& name, const Fault& fault) {
    std::vector<SuiteResult> results = compared_results(name);
    for (SuiteResult& result : results) fault(result);
    return out_of_bands(read_bands(bands_file()), name, values_of(results));
  }
  static Fault each_row(const std::function<void(JointPositions&)>& change) {
    return [change](SuiteResult& result) {
      for (JointPositions& joints : result.estimate.joints) change(joints);
    };
  }
  static bool are_there(std::string_view name) {
    return is_there(*std::ranges::find(suite_scenes(), name, &SuiteScene::name));
  }
};

TEST_F(RealClips, FaultsBeforeTwoTelephonesLeaveTheirBands) {
  if (!are_there("clip_two_telephones")) GTEST_SKIP() << "no ../shared/data";
  const std::map<std::string, Fault> faults{
      {"legs swapped", each_row(mirror_legs)},
      {"a foot's length beside them", each_row([](JointPositions& joints) {
         for (Vector3d& p : joints.at) p.y() += 0.25;
       })},
      {"no pose", each_row([](JointPositions& joints) { joints = unknown_joints(); })},
      {"found a second late", [](SuiteResult& result) { result.clip->run.first_tracked += 1; }},
      {"walks while they stand", [](SuiteResult& result) {
         for (double& p : result.clip->run.standing) p = 0;
       }}};
  for (const auto& [name, fault] : faults)
    EXPECT_THAT(noticed("clip_two_telephones", fault), testing::Not(testing::IsEmpty())) << name;
}

TEST_F(RealClips, AWalkerBesideTheirPlaceLeavesTheBands) {
  if (!are_there("clip_walker_1")) GTEST_SKIP() << "no ../shared/data";
  const Fault beside = each_row([](JointPositions& joints) {
    for (Vector3d& p : joints.at) p.x() += 1;
  });
  EXPECT_THAT(noticed("clip_walker_1", beside), testing::Not(testing::IsEmpty()));
}

TEST_F(RealClips, AnInventedWalkLeavesTheBands) {
  if (!are_there("clip_squats")) GTEST_SKIP() << "no ../shared/data";
  const auto walk = [](SuiteResult& result) { result.clip->run.passed = true; };
  EXPECT_THAT(noticed("clip_squats", walk), testing::Not(testing::IsEmpty()));
  const auto steps = [](SuiteResult& result) { result.clip->run.steps = 3; };
  EXPECT_THAT(noticed("clip_squats", steps), testing::Not(testing::IsEmpty()));
}

}  // namespace
}  // namespace walktrack
