#include "jobs/track/report/report_curves.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/run_program.h"

namespace walktrack {
namespace {

// A table with a band of -/+ 1 around the same value in every row.
std::string table(const std::vector<std::pair<std::string, double>>& columns, int rows) {
  std::string text = "t";
  for (const auto& [name, value] : columns) text += fmt::format(",{0},{0}_p05,{0}_p95", name);
  for (int i = 0; i < rows; ++i) {
    text += fmt::format("\n{}", 0.1 * i);
    for (const auto& [name, value] : columns)
      text += fmt::format(",{},{},{}", value, value - 1, value + 1);
  }
  return text + "\n";
}

std::vector<std::pair<std::string, double>> kinetics_columns() {
  std::vector<std::pair<std::string, double>> columns;
  for (const char* side : {"l", "r"}) {
    columns.insert(columns.end(), {{fmt::format("{}_grf_x_n", side), 10},
                                   {fmt::format("{}_grf_y_n", side), -686.4655},
                                   {fmt::format("{}_grf_z_n", side), 20},
                                   {fmt::format("{}_hip_flexion_nm", side), 35},
                                   {fmt::format("{}_knee_flexion_nm", side), 7},
                                   {fmt::format("{}_ankle_dorsiflexion_nm", side), -70}});
  }
  return columns;
}

TEST(LoadSignals, AreVerticalInTheWorldAndPerWeightAndMass) {
  const TemporaryFolder place;
  place.write("kinetics.csv", table(kinetics_columns(), 3));
  AnalysedMotion analysed;  // 70 kg
  // A calibration whose y axis points down.
  analysed.world = world_frame_on_ground({0, -1, 0}, 0);
  const ResultFolder folder({place.path() / "out", "test", motion_table_files()}, false);
  std::filesystem::rename(place / "kinetics.csv", folder.file("kinetics.csv"));
  const auto signals = load_signals(folder, analysed);
  ASSERT_EQ(signals.size(), 8u);
  EXPECT_EQ(signals[0].name, "vertical_load");
  EXPECT_NEAR(signals[0].value[0], 1, 1e-9);  // 686.4655 N / (70 kg 9.80665 m/s^2)
  EXPECT_LT(signals[0].p05[0], signals[0].value[0]);
  EXPECT_GT(signals[0].p95[0], signals[0].value[0]);
  EXPECT_EQ(signals[3].name, "ankle_dorsiflexion_moment");
  EXPECT_DOUBLE_EQ(signals[3].value[2], -1);
  EXPECT_EQ(signals[7].side, Side::kRight);
}

TEST(AngleSignals, LeanForwardsIsPositive) {
  const TemporaryFolder place;
  const ResultFolder folder({place.path() / "out", "test", motion_table_files()}, false);
  std::vector<std::pair<std::string, double>> columns{{"pelvis_tilt_deg", -8}};
  for (const char* side : {"l", "r"})
    for (const char* angle : {"hip_flexion", "knee_angle", "ankle_angle"})
      columns.emplace_back(fmt::format("{}_{}_deg", angle, side), 20);
  folder.write("angles.csv", table(columns, 3));
  for (const Signal& signal : angle_signals(folder.path())) {
    EXPECT_EQ(signal.value[1], signal.name == "pelvis_tilt" ? 8 : 20) << signal.name;
    EXPECT_EQ(signal.p95[1] - signal.p05[1], 2) << signal.name;
  }
}

TEST(CyclesJson, CutsEachSideAtItsOwnStrikes) {
  Gait gait;
  for (const auto& [time, side] :
       {std::pair{0.0, Side::kLeft}, {0.5, Side::kRight}, {1.0, Side::kLeft}, {2.0, Side::kLeft}})
    gait.events.push_back({time, side, GaitEventKind::kFootStrike});
  Signal signal;
  signal.name = "ramp";
  for (int i = 0; i <= 20; ++i) {
    signal.time.push_back(0.1 * i);
    signal.value.push_back(i);
  }
  signal.p05 = signal.p95 = signal.value;
  Signal right = signal;
  right.side = Side::kRight;
  const auto json = cycles_json({signal, right}, gait);
  EXPECT_EQ(json[0]["count"], 2);
  EXPECT_EQ(json[0]["strides"][1]["values"][50], 15);
  EXPECT_EQ(json[0]["mean"][50], 10);
  EXPECT_EQ(json[1]["count"], 0);
  EXPECT_TRUE(json[1]["mean"][0].is_null());
}

}  // namespace
}  // namespace walktrack
