#include "jobs/evaluate/evaluate.h"

#include <cmath>
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/errors.h"
#include "io/archive/files.h"
#include "io/tables/kinetics_file.h"
#include "io/tables/motion_file.h"
#include "tests/metrics/test_walk.h"

namespace walktrack {
namespace {

namespace fs = std::filesystem;

class Evaluate : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) /
              testing::UnitTest::GetInstance()->current_test_info()->name();
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path write(const std::string& name, const std::string& text) const {
    fs::create_directories((folder_ / name).parent_path());
    write_file_atomically(folder_ / name, text);
    return folder_ / name;
  }

  static double figure(const EvaluatedEstimate& estimate, const std::string& key) {
    for (const Figure& one : estimate.figures) {
      if (one.key == key) return one.value;
    }
    ADD_FAILURE() << "no figure " << key;
    return 0;
  }

  fs::path folder_;
};

Motion moved_by(const Motion& motion, const Eigen::Vector3d& shift) {
  return changed(motion, [&](JointPositions& joints, size_t) {
    for (Eigen::Vector3d& p : joints.at) p += shift;
  });
}

TEST_F(Evaluate, JointsSideBySideFromFilesAndResultFolders) {
  const Motion truth = walk_motion({});
  EvaluateJob job;
  job.truth = write("truth.csv", motion_csv(truth));
  job.estimates = {write("good.csv", motion_csv(truth)), folder_ / "out"};
  write("out/joints.csv", motion_csv(moved_by(truth, {0.03, 0.04, 0})));
  const auto results = evaluate(job);
  ASSERT_EQ(results.size(), 2u);
  // Tables have micrometres.
  EXPECT_NEAR(figure(results[0], "joint_error_mean_mm"), 0, 1e-3);
  EXPECT_NEAR(figure(results[1], "joint_error_mean_mm"), 50, 1e-2);
  EXPECT_EQ(figure(results[1], "filled_percent"), 100);
  EXPECT_NEAR(figure(results[1], "angle_lknee_flexion_rms_deg"), 0, 1e-3);
  EXPECT_EQ(figure(results[1], "events_missed"), 0);
  EXPECT_TRUE(std::isnan(figure(results[1], "error_lwrist_mm")));
}

TEST_F(Evaluate, UsesTheUncertaintyBesideAnEstimate) {
  const Motion truth = walk_motion({});
  JointUncertainty around{truth.time, truth.joints, truth.joints, truth.joints};
  for (size_t i = 0; i < truth.time.size(); ++i) {
    for (Eigen::Vector3d& p : around.p05[i].at) p.array() -= 0.01;
    for (Eigen::Vector3d& p : around.p95[i].at) p.array() += 0.01;
  }
  EvaluateJob job;
  job.truth =
      write("truth.csv", motion_csv(moved_by(truth, {0, 0, 0.02})));  // outside along z only
  job.estimates = {folder_ / "out"};
  write("out/joints.csv", motion_csv(truth));
  write("out/uncertainty.csv", uncertainty_csv(truth, around));
  EXPECT_NEAR(figure(evaluate(job)[0], "coverage90_percent"), 200.0 / 3, 1e-9);
  job.estimates.push_back(folder_ / "out");
  job.uncertainty = folder_ / "out/uncertainty.csv";
  EXPECT_THROW(evaluate(job), UsageError);
}

TEST_F(Evaluate, GaitParametersHaveErrors) {
  TestWalk longer;
  longer.speed *= 1.1;
  EvaluateJob job;
  job.truth = write("truth.csv", motion_csv(walk_motion({})));
  job.estimates = {write("estimate.csv", motion_csv(walk_motion(longer)))};
  const auto result = evaluate(job);
  EXPECT_NEAR(figure(result[0], "step_length_error_m"), 0.1 * 1.2 * 0.55, 0.005);
  for (const char* key : {"speed", "step_length", "step_width"}) {
    const std::string unit = std::string(key) == "speed" ? "_m_s" : "_m";
    EXPECT_NEAR(figure(result[0], std::string(key) + "_error" + unit),
                figure(result[0], key + unit) - figure(result[0], "truth_" + (key + unit)), 1e-12);
  }
  EXPECT_NEAR(figure(result[0], "step_time_error_s"), 0, 0.01);
}

// A kinetics.csv beside the truth and one beside the estimate.
TEST_F(Evaluate, ComparesGroundForcesWhereBothAreThere) {
  const Motion walk = walk_motion({});
  const auto forces = [&](double extra) {
    Kinetics of;
    for (const double time : walk.time) {
      KineticsFrame frame;
      frame.known = true;
      frame.com.setZero();
      frame.feet[0].force = {extra, 0, 700 + 2 * extra};
      of.time.push_back(time);
      of.frames.push_back(frame);
    }
    return simulated_kinetics_csv(of);
  };
  EvaluateJob job;
  job.truth = write("scene/truth.csv", motion_csv(walk));
  job.estimates = {folder_ / "out"};
  write("out/joints.csv", motion_csv(walk));
  write("out/kinetics.csv", forces(15));
  const auto keys = [](const EvaluatedEstimate& estimate) {
    std::vector<std::string> out;
    for (const Figure& one : estimate.figures) out.push_back(one.key);
    return out;
  };
  EXPECT_THAT(keys(evaluate(job)[0]), testing::Not(testing::Contains("force_vertical_rms_n")));
  write("scene/kinetics.csv", forces(0));
  const auto result = evaluate(job);
  EXPECT_NEAR(figure(result[0], "force_vertical_rms_n"), 30, 1e-3);
  EXPECT_NEAR(figure(result[0], "force_horizontal_rms_n"), 15, 1e-3);
}

TEST_F(Evaluate, ThePlotShowsEveryEstimateAndNeedsJoints) {
  const Motion truth = walk_motion({});
  EvaluateJob job;
  job.truth = write("truth.csv", motion_csv(truth));
  job.estimates = {write("good.csv", motion_csv(truth)),
                   write("bad.csv", motion_csv(moved_by(truth, {0.03, 0.04, 0})))};
  const auto results = evaluate(job);
  ASSERT_TRUE(results[1].series);
  EXPECT_NEAR(results[1].series->error_mm.back(), 50, 1e-2);
  EXPECT_NEAR(results[1].series->joint_mm[static_cast<size_t>(Joint::kLeftKnee)], 50, 1e-2);
  const std::string svg = as_svg("truth.csv", results);
  EXPECT_THAT(svg, testing::HasSubstr("good.csv"));
  EXPECT_THAT(svg, testing::HasSubstr("bad.csv"));
  job.truth = write("ground.csv", "t,x,y\n0.5,0.6,0.3\n1.0,1.2,0.3\n");
  EXPECT_THROW(as_svg("ground.csv", evaluate(job)), UsageError);
}

TEST_F(Evaluate, FootPlantsAndGroundPointsAreRecognisedByTheirHeaders) {
  const TestWalk walk;
  EvaluateJob job;
  job.estimates = {write("estimate.csv", motion_csv(walk_motion(walk)))};
  // The right foot is on the ground 0.8 strides of 1.32 m after the start from frame 16.5 to 36.3.
  job.truth =
      write("plants.csv", "# by hand\nstance,side,on_frame,off_frame,x_m\n0,r,17,36,1.056\n");
  auto result = evaluate(job);
  EXPECT_EQ(figure(result[0], "plants_found"), 1);
  EXPECT_LT(figure(result[0], "plant_error_mean_mm"), 1);
  job.truth = write("ground.csv", "t,x,y\n0.5,0.6,0.3\n1.0,1.2,0.3\n");
  result = evaluate(job);
  EXPECT_NEAR(figure(result[0], "ground_error_median_mm"), 300, 1e-2);
}

TEST_F(Evaluate, SaysWhatItFoundInAFileThatIsNoTruth) {
  EvaluateJob job;
  job.estimates = {write("estimate.csv", motion_csv(walk_motion({})))};
  job.truth = write("odd.csv", "time,knee\n0,1\n");
  try {
    evaluate(job);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("time,knee"), std::string::npos) << error.what();
  }
  job.truth = write("plants.csv", "stance,side,on_frame,off_frame,x_m\n0,left,17,36,1\n");
  EXPECT_THROW(evaluate(job), InputError);
  job.truth = folder_ / "missing.csv";
  EXPECT_THROW(evaluate(job), InputError);
}

TEST(EvaluateOutput, MarkdownAndJsonHoldTheSameFigures) {
  const std::vector<EvaluatedEstimate> all{
      {"a", {{"x_mm", "x, mm", 1.25, 1}, {"z_mm", "z, mm", 7, 1, true}}, {}},
      {"b", {{"y_s", "y, s", std::nan(""), 2}}, {}}};
  const std::string table = as_markdown("truth.csv", all);
  EXPECT_NE(table.find("| x, mm     |      1.2 |        - |"), std::string::npos) << table;
  EXPECT_EQ(table.find("y, s"), std::string::npos);   // unknown in all estimates
  EXPECT_EQ(table.find("z, mm"), std::string::npos);  // a detail
  const auto json = nlohmann::json::parse(as_json("truth.csv", all));
  EXPECT_EQ(json["estimates"][0]["x_mm"], 1.25);
  EXPECT_EQ(json["estimates"][0]["z_mm"], 7);
  EXPECT_TRUE(json["estimates"][1]["y_s"].is_null());
}

}  // namespace
}  // namespace walktrack
