#include "io/archive/origin.h"

#include <gtest/gtest.h>

#include "io/archive/run_record.h"

namespace walktrack {
namespace {

const Origin kFound{{"version of the program", "1.0 abc"},
                    {"filter.particles", "120"},
                    {"content of side.mp4", "1f"}};

TEST(Differences, AreNamed) {
  EXPECT_EQ(differences(kFound, kFound), "");
  Origin wanted = kFound;
  wanted[0].second = "1.1 abd";
  EXPECT_EQ(differences(kFound, wanted), "version of the program 1.0 abc -> 1.1 abd");
  wanted = kFound;
  wanted[1].second = "60";
  wanted[2].second = "2f";
  EXPECT_EQ(differences(kFound, wanted), "filter.particles 120 -> 60, side.mp4 has changed");
  wanted = {{"content of front.mp4", "1f"}, kFound[0]};
  EXPECT_EQ(differences(kFound, wanted),
            "front.mp4 is new, filter.particles 120 -> not known, side.mp4 is not read any more");
}

TEST(Differences, OfManyTheFirstAreNamed) {
  Origin wanted;
  for (int i = 0; i < 7; ++i) wanted.emplace_back("content of " + std::to_string(i), "");
  EXPECT_EQ(differences({}, wanted), "0 is new, 1 is new, 2 is new, 3 is new and 3 more");
}

// Every setting is in it, as the file has it; threads, which change no result, are not.
TEST(OriginIn, ARunsText) {
  RunRecord record;
  record.inputs = {{"side.mp4", "1f"}};
  const Origin before = origin_in(run_json(record));
  for (const auto& [setting, words] :
       {std::pair{"filter.particles=7", "filter.particles "},
        {"motion.model=markov", "motion.model kneed -> markov"},
        {"body.arms=true", "body.arms false -> true"},
        {"seed=2", "seed 1 -> 2"},
        {"observation.flow.enabled=true", "observation.flow.enabled"}}) {
    RunRecord other = record;
    apply_setting(other.config, setting, "test");
    EXPECT_EQ(differences(before, origin_in(run_json(other))).find(words), 0u) << setting;
  }
  apply_setting(record.config, "threads=3", "test");
  EXPECT_EQ(differences(before, origin_in(run_json(record))), "");
  record.inputs[0].second = "2f";
  EXPECT_EQ(differences(before, origin_in(run_json(record))), "side.mp4 has changed");
}

TEST(OriginIn, WhatIsNoSuchTextIsNothing) {
  EXPECT_TRUE(origin_in("no JSON").empty());
  EXPECT_TRUE(origin_in("[]").empty());
  EXPECT_NE(differences(origin_in("{\"config\": 3}"), kFound), "");
}

}  // namespace
}  // namespace walktrack
