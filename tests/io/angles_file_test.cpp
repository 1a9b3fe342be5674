#include "io/tables/angles_file.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/conventions.h"
#include "io/tables/csv.h"

namespace walktrack {
namespace {

TEST(AnglesFile, HasDegreesBandsAndEmptyCellsForTheUnknown) {
  AngleRow known{0.5, Pose{}, JointAngles{}, JointAngles{}};
  known.pose->legs[0].knee_flexion = rad_from_deg(30);
  (*known.p05)[kKneeAngleL] = rad_from_deg(28);
  (*known.p95)[kKneeAngleL] = rad_from_deg(33);
  const std::string text = joint_angles_csv({{0.25, {}, {}, {}}, known});
  EXPECT_TRUE(text.starts_with("t,pelvis_tilt_deg,"));
  EXPECT_EQ(nlohmann::json::parse(joint_angles_notes(4).json).at("rate_hz"), 4);
  const CsvTable table = csv_from_text(text, "angles.csv");
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_FALSE(table.optional_number(table.rows[0], table.column("knee_angle_l_deg")));
  EXPECT_EQ(table.number(table.rows[1], table.column("t")), 0.5);
  EXPECT_NEAR(table.number(table.rows[1], table.column("knee_angle_l_deg")), 30, 1e-6);
  EXPECT_NEAR(table.number(table.rows[1], table.column("knee_angle_l_deg_p05")), 28, 1e-6);
  EXPECT_NEAR(table.number(table.rows[1], table.column("knee_angle_l_deg_p95")), 33, 1e-6);
  EXPECT_EQ(table.number(table.rows[1], table.column("trunk_tilt_deg")), 0);
}

}  // namespace
}  // namespace walktrack
