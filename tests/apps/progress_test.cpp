// Output for programs: progress, messages and errors as JSON, one line with the result, and logs of
// long runs.
#include "apps/progress_pace.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/data_folders.h"
#include "tests/run_program.h"

namespace walktrack {
namespace {

using namespace std::chrono_literals;
using Record = nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

std::vector<Record> lines_of(const std::string& text) {
  std::vector<Record> out;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) out.push_back(Record::parse(line));
  return out;
}

TEST(ProgressPace, ABarIsDrawnAtOnceAndAtTheEnd) {
  ProgressPace pace(100ms);
  const auto start = ProgressPace::Clock::now();
  EXPECT_TRUE(pace.due({"tracking", 0, 10}, start));
  EXPECT_TRUE(pace.new_stage());
  EXPECT_FALSE(pace.due({"tracking", 1, 10}, start + 50ms));
  EXPECT_TRUE(pace.due({"tracking", 2, 10}, start + 100ms));
  EXPECT_FALSE(pace.new_stage());
  EXPECT_NEAR(pace.per_second(), 20, 1e-9);
  EXPECT_NEAR(pace.seconds_left(), 0.4, 1e-9);
  EXPECT_TRUE(pace.due({"tracking", 10, 10}, start + 110ms));
  EXPECT_TRUE(pace.due({"drawing", 0, 0}, start + 120ms));
  EXPECT_TRUE(std::isnan(pace.seconds_left()));
}

TEST(ProgressPace, ALogSaysNothingOfShortStagesAndEverythingOfLongOnes) {
  ProgressPace pace(30s, true);
  const auto start = ProgressPace::Clock::now();
  EXPECT_FALSE(pace.due({"checking", 0, 3}, start));
  EXPECT_FALSE(pace.due({"checking", 3, 3}, start + 2s));
  EXPECT_FALSE(pace.due({"tracking", 0, 100}, start + 3s));
  EXPECT_FALSE(pace.due({"tracking", 20, 100}, start + 32s));
  const Progress now{"tracking", 30, 100};
  EXPECT_TRUE(pace.due(now, start + 33s));
  EXPECT_EQ(progress_text(now, pace), "tracking 30/100  1.0/s  70 s left");
  EXPECT_FALSE(pace.due({"tracking", 40, 100}, start + 43s));
  EXPECT_TRUE(pace.due({"tracking", 100, 100}, start + 44s));
}

TEST(ProgressPace, AResumedRunsPaceIsItsOwn) {
  ProgressPace pace(1s);
  const auto start = ProgressPace::Clock::now();
  pace.due({"tracking", 900, 1000}, start);
  pace.due({"tracking", 910, 1000}, start + 10s);
  EXPECT_NEAR(pace.per_second(), 1, 1e-9);
  EXPECT_NEAR(pace.seconds_left(), 90, 1e-9);
}

TEST(ProgressOption, JsonGivesLinesThatProgramsRead) {
  const TemporaryFolder folder;
  const ProgramResult result =
      run_walktrack({"simulate", "--model", "kneed", "--duration", "5", "--no-pictures",
                     "--progress", "json", "-o", folder / "out"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const std::vector<Record> lines = lines_of(result.err);
  ASSERT_GE(lines.size(), 2u);
  bool progress = false, message = false;
  for (const Record& line : lines) {
    progress |= line.at("event") == "progress" && line.at("what") == "simulating" &&
                line.at("total") == 5000 && line.at("done") > 0;
    message |= line.at("event") == "message";
  }
  EXPECT_TRUE(progress && message) << result.err;
}

TEST(ProgressOption, ErrorsAreJsonTooAndTheResultLineNamesThem) {
  const TemporaryFolder folder;
  const ProgramResult result = run_walktrack(
      {"track", folder / "no\"scene.yaml", "-o", folder / "out", "--progress=json", "--json-line"});
  EXPECT_EQ(result.exit_code, 3);
  const Record error = Record::parse(result.err), line = Record::parse(result.out);
  EXPECT_EQ(error.at("event"), "error");
  EXPECT_EQ(error.at("exit"), 3);
  EXPECT_EQ(line.at("status"), "error");
  EXPECT_EQ(line.at("command"), "track");
  EXPECT_EQ(line.at("exit"), 3);
  EXPECT_THAT(line.at("trouble").get<std::string>(), HasSubstr("no\"scene.yaml"));
}

TEST(ProgressOption, IsRefusedWhereItMakesNoSense) {
  const ProgramResult word = run_walktrack({"check", "scene.yaml", "--progress", "xml"});
  EXPECT_EQ(word.exit_code, 2);
  EXPECT_THAT(word.err, HasSubstr("auto, json or none"));
  EXPECT_EQ(run_walktrack({"check", "scene.yaml", "--progress", "json", "--quiet"}).exit_code, 2);
}

TEST(TrackCommand, EndsWithWhatAPersonAndAProgramWantToKnow) {
  const TemporaryFolder folder;
  const ProgramResult result = run_walktrack(
      {"track", kDemo / "scene.yaml", "-o", folder / "out", "--no-overlay", "--json-line", "--set",
       "filter.particles=100", "--set", "quality.least_steps=90", "--set", "start.particles=200"});
  ASSERT_EQ(result.exit_code, 4) << result.err;
  EXPECT_THAT(
      result.err,
      AllOf(HasSubstr("\n  steps        "), HasSubstr("\n  speed        1."), HasSubstr(" m/s ("),
            HasSubstr("\n  cadence      "), HasSubstr("\n  step length  0."),
            HasSubstr("\n  failed: Changes of the standing foot: "),
            HasSubstr("(allowed: at least 90)\n    The tracked figure took no step"),
            HasSubstr("\n  open " + (folder / "out/report.html"))));
  const Record line = Record::parse(result.out),
               gait = Record::parse(read_file(folder / "out/gait.json"));
  const Record& both = gait.at("summary").at("both");
  EXPECT_EQ(line.at("exit"), 4);
  EXPECT_EQ(line.at("status"), "below gates");
  EXPECT_EQ(line.at("steps"), gait.at("summary").at("steps"));
  EXPECT_EQ(line.at("speed_m_s").dump(), both.at("speed_m_s").dump());
  EXPECT_EQ(line.at("cadence_steps_per_min").dump(), both.at("cadence_steps_per_min").dump());
  EXPECT_EQ(line.at("step_length_m").dump(), both.at("step_length_m").dump());
  ASSERT_GE(line.at("failed_checks").size(), 1u);
  EXPECT_EQ(line.at("failed_checks")[0].at("at_least"), 90);
  EXPECT_THAT(line.at("failed_checks")[0].at("advice").get<std::string>(), Not(IsEmpty()));
  EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), 1);
}

}  // namespace
}  // namespace walktrack
