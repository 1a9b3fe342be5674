// simulate and cycle from outside.
#include <filesystem>
#include <fstream>

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

// The scale of the image follows the figure: a foot of a thousand kilometres once took forever to
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

TEST(SimulateCommand, HasAnExitCodeForWalkersThatFall) {
  const TemporaryFolder temporary;
  const ProgramResult fallen =
      run_walktrack({"simulate", "--model", "rimless_wheel", "--set", "start.qd=-0.5", "--duration",
                     "30", "--no-pictures", "-o", temporary / "fallen"});
  EXPECT_EQ(fallen.exit_code, 4) << fallen.err;
  EXPECT_THAT(fallen.err, HasSubstr("fallen"));
  EXPECT_TRUE(std::filesystem::exists(temporary / "fallen/run.json"));
  const ProgramResult diverged = run_walktrack(
      {"simulate", "--model", "articulated", "--set", "start.spin=[900000,900000,0]", "--step",
       "0.05", "--integrator", "euler", "--no-pictures", "-o", temporary / "diverged"});
  EXPECT_EQ(diverged.exit_code, 4) << diverged.err;
  EXPECT_THAT(diverged.err, HasSubstr("diverged"));
}

// Nothing is clamped, ignored or tried for ever: one line states what is allowed.
TEST(SimulateCommand, RefusesWhatItWouldNotDo) {
  const TemporaryFolder temporary;
  const auto refused = [&](const std::vector<std::string>& words, const std::string& message) {
    std::vector<std::string> all{"simulate", "-o", temporary / "out"};
    all.insert(all.end(), words.begin(), words.end());
    const ProgramResult result = run_walktrack(all);
    EXPECT_EQ(result.exit_code, 2) << result.err;
    EXPECT_THAT(result.err, HasSubstr(message));
  };
  const std::vector<std::string> kneed{"--model", "kneed"}, prior{"--model", "kneed", "--prior"};
  const auto with = [](std::vector<std::string> words, const std::vector<std::string>& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
  };
  refused(with(kneed, {"--step", "1e-12"}), "--step: found 1e-12, allowed: a number from 1e-06");
  refused(with(kneed, {"--step", "1e-6", "--duration", "1000"}), "1e+09 steps");
  refused(with(kneed, {"--steps", "-5"}), "--steps: found -5");
  refused(with(kneed, {"--sample", "1e-6", "--duration", "100"}), "1e+08 rows");
  refused(with(kneed, {"--slow", "1000", "--duration", "1000"}), "frames of animation");
  refused(with(kneed, {"--duration", "1", "--seconds", "2"}), "one of them");
  refused(with(kneed, {"--feedback", "0.5"}), "allowed: this option together with --prior");
  refused(with(kneed, {"--threads", "many"}), "threads");
  refused(with(prior, {"--set", "slope=0.2"}), "0.2 rad of slope, allowed: -0.08 to 0.08");
  refused(with(prior, {"--step-length", "0.35"}), "0.35 m at 1.3 m/s, allowed: 0.");
  refused(with(prior, {"--set", "controls.hip.rest=0.2"}), "allowed: parameters.*");
  refused({"--model", "articulated", "--steps", "3"}, "--steps");
  refused({"--model", "articulated", "--prior"}, "--prior");
  refused({"--extremes", "--model", "kneed"}, "--model");
}

TEST(PriorCommand, RefusesOptionsOfItsOtherHalf) {
  const TemporaryFolder temporary;
  const std::string out = temporary / "out";
  EXPECT_EQ(run_walktrack({"prior", "--show", "--level", "-o", out}).exit_code, 2);
  EXPECT_EQ(run_walktrack({"prior", "--height", "1.6", "-o", out}).exit_code, 2);
  EXPECT_EQ(
      run_walktrack({"prior", "--model", "anthropomorphic", "--sweeps", "2", "-o", out}).exit_code,
      2);
}

// The error for a wrong model file differs from that for a missing one.
TEST(WalkerCommands, NameWhatIsWrongInAModelFile) {
  const TemporaryFolder temporary;
  const std::string file = temporary / "model.yaml";
  const auto message = [&](const std::string& text) {
    std::ofstream(file) << text;
    const ProgramResult result = run_walktrack({"cycle", "--config", file});
    EXPECT_GE(result.exit_code, 2);
    EXPECT_LE(result.exit_code, 3);
    EXPECT_THAT(result.err, HasSubstr(file));
    return result.err;
  };
  EXPECT_THAT(message("\nmodle: kneed\n"), HasSubstr(":2: modle: found an unknown key, did you"));
  EXPECT_THAT(message("model: kneeed\n"), HasSubstr(":1: model: found 'kneeed', allowed: mono"));
  EXPECT_THAT(message("parameters: {slope: 0.1}\n"), HasSubstr("model: found nothing"));
  EXPECT_THAT(message("- kneed\n"), HasSubstr(":1: found a list, allowed: a map"));
  EXPECT_THAT(message("model: kneed\nstart: {q: [1, 2]}\n"),
              HasSubstr(":2: start.q: found 2 numbers, allowed: 5"));
  EXPECT_THAT(message("model: kneed\nparameters: {slope: }\n"),
              HasSubstr(":2: parameters.slope: found nothing"));
  EXPECT_THAT(message("model: kneed\nmodel: monopode\n"),
              HasSubstr(":2: model: found the key twice"));
  EXPECT_THAT(message("model: kneed\n---\nmodel: monopode\n"), HasSubstr("a second YAML document"));
}

}  // namespace
}  // namespace walktrack
