#include "io/archive/run_record.h"

#include <cmath>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "io/archive/sha256.h"

namespace walktrack {
namespace {

RunRecord sample_record() {
  RunRecord record;
  record.command = "track";
  record.scene = "scene.yaml";
  apply_setting(record.config, "seed=7", "--seed");
  record.numbers = {{"fallen_particles", 12}};
  record.by_frame = {{"ess", {1.5, NAN}}};
  record.command_line = {"walktrack", "track", "a \"quoted\" name\n\xff"};
  record.threads = 2;
  return record;
}

TEST(RunRecord, IsJsonWithEverythingInIt) {
  const auto json = nlohmann::json::parse(run_json(sample_record()));
  EXPECT_EQ(json["program"]["name"], "walktrack");
  EXPECT_EQ(json["seed"], 7);
  EXPECT_EQ(json["config"]["seed"], 7);
  EXPECT_EQ(json["config_origin"]["seed"], "--seed");
  EXPECT_EQ(json["numbers"]["fallen_particles"], 12);
  EXPECT_EQ(json["by_frame"]["ess"][0], 1.5);
  EXPECT_TRUE(json["by_frame"]["ess"][1].is_null());
  EXPECT_EQ(json["timing"]["threads"], 2);
}

TEST(RunRecord, StatesSpeedsOnlyWhereFramesWereFollowed) {
  const auto timing = [](const RunRecord& record) {
    return nlohmann::json::parse(run_json(record))["timing"];
  };
  RunRecord record = sample_record();
  EXPECT_FALSE(timing(record).contains("frames_per_second"));
  record.frames_per_second = 40;
  EXPECT_EQ(timing(record)["frames_per_second"], 40);
  EXPECT_TRUE(timing(record)["stride_frames_per_second"].is_null());
  record.stride_frames_per_second = 60;
  EXPECT_EQ(timing(record)["stride_frames_per_second"], 60);
}

TEST(RunRecord, OnlyTheTimingBlockKnowsTheThreads) {
  RunRecord one = sample_record(), two = sample_record();
  apply_setting(one.config, "threads=1", "--threads");
  apply_setting(two.config, "threads=8", "--set");
  two.threads = 8;
  two.seconds = 3;
  two.command_line = {"elsewhere"};
  auto left = nlohmann::ordered_json::parse(run_json(one));
  auto right = nlohmann::ordered_json::parse(run_json(two));
  EXPECT_NE(left, right);
  left.erase("timing");
  right.erase("timing");
  EXPECT_EQ(left.dump(), right.dump());
}

TEST(ResultDigest, IsThatOfBothTables) { EXPECT_EQ(result_digest("a", "bc"), sha256("abc")); }

}  // namespace
}  // namespace walktrack
