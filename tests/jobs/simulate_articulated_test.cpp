#include "jobs/simulate/simulate_articulated.h"

#include <filesystem>

#include <gtest/gtest.h>

#include "core/errors.h"
#include "io/tables/csv.h"

namespace walktrack {
namespace {

using Eigen::VectorXd;

CsvTable table_of(const ArticulatedJob& job) {
  const ArticulatedBody body = articulated_person(job.spec);
  return csv_from_text(states_csv(body, job, record(body, job)), "states.csv");
}

double value(const CsvTable& table, size_t row, const char* column) {
  return table.number(table.rows[row], table.column(column));
}

TEST(ArticulatedJob, ThePersonHasTheMassAskedFor) {
  const ArticulatedSpec spec{.mass = 82};
  EXPECT_NEAR(articulated_person(spec).mass(), 82, 1e-10);
}

TEST(ArticulatedJob, TumblingKeepsEnergyAndAngularMomentum) {
  ArticulatedJob job;
  job.duration = 1;
  job.spec.velocity = {1, 0.5, 3};
  job.spec.spin = {1, 4, 2};
  job.spec.left_hip = {0.2, -0.8, 0};
  job.spec.right_knee = 0.7;
  const CsvTable table = table_of(job);
  const size_t last = table.rows.size() - 1;
  EXPECT_NEAR(value(table, last, "t"), 1, 1e-9);
  for (const char* axis : {"spin_x", "spin_y", "spin_z"}) {
    EXPECT_NEAR(value(table, last, axis), value(table, 0, axis), 1e-6);
  }
  const auto energy = [&](size_t row) {
    return value(table, row, "kinetic") + value(table, row, "gravity");
  };
  EXPECT_NEAR(energy(last), energy(0), 1e-6 * energy(0));  // RK4 at 1 ms
}

TEST(ArticulatedJob, HangingByTheHeadTheHoldCarriesTheWeight) {
  ArticulatedJob job;
  job.duration = 1;
  job.spec.hold_head = true;
  job.spec.position = {0, 0, -0.8};
  const CsvTable table = table_of(job);
  const double weight = job.spec.mass * job.spec.gravity;
  for (size_t row = 0; row < table.rows.size(); ++row) {
    EXPECT_NEAR(value(table, row, "hold_z"), weight, 1e-6 * weight);
    EXPECT_LT(value(table, row, "hold_drift"), 1e-12);
  }
}

TEST(ArticulatedJob, DivergenceIsReportedAndTheTableStaysFinite) {
  ArticulatedJob job;
  job.step = 0.05;
  job.spec.spin = {100, 200, 300};
  const ArticulatedBody body = articulated_person(job.spec);
  const ArticulatedRecording recording = record(body, job);
  EXPECT_TRUE(recording.diverged);
  const std::string csv = states_csv(body, job, recording);
  EXPECT_EQ(csv.find("nan"), std::string::npos);
  EXPECT_EQ(csv.find("inf"), std::string::npos);
}

TEST(ArticulatedJob, WritesItsFolderAndChecksItsLists) {
  const auto folder = std::filesystem::path(testing::TempDir()) / "simulate_articulated";
  std::filesystem::remove_all(folder);
  ArticulatedJob job;
  job.duration = 0.3;
  job.spec.hold_left_foot = true;
  job.spec.spin = {0, 1, 0};
  simulate_articulated_into(folder, false, job, {"walktrack"});
  for (const char* name : {"states.csv", "strip.svg", "strip.png", "animation.mp4", "run.json"}) {
    EXPECT_GT(std::filesystem::file_size(folder / name), 50u) << name;
  }
  job.spec.spin = {1, 2};
  EXPECT_THROW(simulate_articulated_into(folder, true, job, {}), UsageError);
}

}  // namespace
}  // namespace walktrack
