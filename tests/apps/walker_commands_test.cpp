// simulate and cycle from outside.
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/run_program.h"

namespace walktrack {
namespace {

using testing::HasSubstr;

TEST(CycleCommand, PrintsJsonToStdoutAndTextToStderr) {
  const ProgramResult result = run_walktrack({"cycle", "--model", "rimless_wheel"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("\"stable\": true"));
  EXPECT_THAT(result.err, HasSubstr("stable limit cycle"));
}

TEST(CycleCommand, FailsWithOneWhereThereIsNoCycle) {
  const ProgramResult result =
      run_walktrack({"cycle", "--model", "rimless_wheel", "--set", "slope=0", "--max-time", "5"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("no limit cycle"));
}

TEST(WalkerCommands, UsageErrors) {
  EXPECT_EQ(run_walktrack({"cycle"}).exit_code, 2);
  EXPECT_EQ(run_walktrack({"simulate", "--model", "kneed"}).exit_code, 2);  // no --output
  EXPECT_EQ(run_walktrack({"cycle", "--model", "kneed", "--step", "0"}).exit_code, 2);
  EXPECT_EQ(run_walktrack({"cycle", "--model", "kneed", "--integrator", "rk5"}).exit_code, 2);
  EXPECT_EQ(run_walktrack({"cycle", "--model", "kneed", "--follow", "slope"}).exit_code, 2);
  EXPECT_EQ(run_walktrack({"cycle", "--model", "kneed", "--settle", "-1"}).exit_code, 2);
  EXPECT_EQ(run_walktrack({"cycle", "--config", "no_such_file.yaml"}).exit_code, 3);
}

TEST(SimulateCommand, WritesAFolderAndRefusesToOverwriteIt) {
  const TemporaryFolder temporary;
  const std::string folder = temporary / "gait";
  const std::vector<std::string> arguments{
      "simulate", "--model", "rimless_wheel", "--duration", "4", "--no-pictures", "-o", folder};
  EXPECT_EQ(run_walktrack(arguments).exit_code, 0);
  EXPECT_TRUE(std::filesystem::exists(folder + "/run.json"));
  EXPECT_EQ(run_walktrack(arguments).exit_code, 2);
}

TEST(SimulateCommand, WalksOutOfTheTableOfGaits) {
  const TemporaryFolder temporary;
  const std::string folder = temporary / "walk";
  const ProgramResult result =
      run_walktrack({"simulate", "--model", "kneed", "--prior", "--speed", "1.3", "--speed-at",
                     "1:1.5", "--seconds", "3", "--no-pictures", "-o", folder});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("3.000 s, sound"));
  const std::vector<std::vector<std::string>> wrong{
      {"--speed-at", "5"}, {"--speed-at", "5:-1"}, {"--speed", "0"}, {"--feedback", "-1"}};
  for (std::vector<std::string> words : wrong) {
    words.insert(words.begin(), {"simulate", "--model", "kneed", "--prior", "-o", folder + "2"});
    EXPECT_EQ(run_walktrack(words).exit_code, 2) << words.back();
  }
  EXPECT_EQ(run_walktrack({"simulate", "--model", "monopode", "--prior", "-o", folder}).exit_code,
            2);
}

TEST(SimulateCommand, WalksOutOfTheAnthropomorphicWalkersTable) {
  const TemporaryFolder temporary;
  const std::string folder = temporary / "walk";
  const ProgramResult result =
      run_walktrack({"simulate", "--model", "anthropomorphic", "--prior", "--speed", "1.1",
                     "--seconds", "4", "--no-pictures", "-o", folder});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("4.000 s, sound"));
  EXPECT_EQ(run_walktrack({"prior", "--model", "wheel", "--show", "-o", folder}).exit_code, 2);
  const std::string table = temporary / "legs.txt";
  EXPECT_EQ(run_walktrack({"prior", "--model", "anthropomorphic", "-o", table}).exit_code, 0);
  EXPECT_TRUE(std::filesystem::exists(table));
}

// The picture's scale follows the figure; a foot of a thousand kilometres once took forever to
// draw.
TEST(SimulateCommand, DrawsGiants) {
  const TemporaryFolder temporary;
  const std::string folder = temporary / "giant";
  const ProgramResult result =
      run_walktrack({"simulate", "--model", "kneed", "--set", "parameters.foot_radius=1e6",
                     "--duration", "0.2", "-o", folder});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(std::filesystem::exists(folder + "/animation.mp4"));
}

}  // namespace
}  // namespace walktrack
