#include "io/tables/gait_file.h"

#include <cmath>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "io/tables/csv.h"

namespace walktrack {
namespace {

GaitTable two_contacts() {
  GaitTable table;
  table.contacts.resize(2);
  table.contacts[0].side = Side::kRight;
  table.contacts[0].at[kToeOff] = {0.75, 0.7, 0.8};
  table.contacts[1].side = Side::kLeft;
  table.contacts[1].at[kFootStrike] = {0.6, 0.58, 0.62};
  table.contacts[1].at[kStepLength] = {0.7012344, 0.69, 0.71};
  table.steps = 1;
  table.both[kSpeed] = {1.25, NAN, NAN};
  return table;
}

TEST(GaitJson, HoldsEventsByTimeAndContactsWithTheirBands) {
  const auto json = nlohmann::json::parse(gait_json(two_contacts()));
  ASSERT_EQ(json.at("events").size(), 2u);
  EXPECT_EQ(json["events"][0]["event"], "foot_strike");
  EXPECT_EQ(json["events"][0]["side"], "left");
  EXPECT_EQ(json["events"][0]["time_s"]["p95"], 0.62);
  EXPECT_EQ(json["events"][1]["event"], "toe_off");
  EXPECT_EQ(json["contacts"][1]["step_length_m"]["value"], 0.701234);
  EXPECT_TRUE(json["contacts"][0]["foot_strike_s"]["value"].is_null());
  EXPECT_EQ(json["summary"]["steps"], 1);
  EXPECT_EQ(json["summary"]["both"]["speed_m_s"]["value"], 1.25);
  EXPECT_TRUE(json["summary"]["both"]["speed_m_s"]["p05"].is_null());
  EXPECT_TRUE(json["summary"]["symmetry"].contains("stance_percent"));
}

TEST(GaitCsv, IsATableThatOurReaderReads) {
  const CsvTable table = csv_from_text(gait_csv(two_contacts()), "gait.csv");
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_EQ(table.rows[0].cells[table.column("side")], "right");
  EXPECT_EQ(table.optional_number(table.rows[0], table.column("toe_off_s_p05")), 0.7);
  EXPECT_FALSE(table.optional_number(table.rows[0], table.column("foot_strike_s")));
}

}  // namespace
}  // namespace walktrack
