// The command line from outside: exit codes, output streams, and messages.
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/run_program.h"

namespace walktrack {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::MatchesRegex;
using testing::Not;
using testing::StartsWith;

// The names in the overview, so that a new command is tested as soon as it is listed.
std::vector<std::string> commands() {
  std::vector<std::string> names;
  std::istringstream lines(run_walktrack({"--help"}).out);
  bool listed = false;
  for (std::string line; std::getline(lines, line);) {
    if (line == "Commands:") {
      listed = true;
    } else if (listed && line.empty()) {
      break;
    } else if (listed) {
      names.push_back(line.substr(2, line.find(' ', 2) - 2));
    }
  }
  return names;
}

TEST(CommandLine, ListsItsCommands) {
  const ProgramResult result = run_walktrack({"--help"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.err, IsEmpty());
  EXPECT_THAT(commands(), testing::Contains("config"));
}

TEST(CommandLine, EveryCommandExplainsItselfWithAnExample) {
  for (const std::string& name : commands()) {
    const ProgramResult result = run_walktrack({name, "--help"});
    EXPECT_EQ(result.exit_code, 0) << name;
    EXPECT_THAT(result.err, IsEmpty()) << name;
    EXPECT_THAT(result.out, StartsWith("usage: walktrack " + name)) << name;
    EXPECT_THAT(result.out, HasSubstr("--set KEY=VALUE")) << name;
    const size_t example = result.out.find("\nExample:\n  walktrack " + name);
    EXPECT_NE(example, std::string::npos) << name;
  }
}

TEST(CommandLine, EveryCommandRefusesAnUnknownOption) {
  for (const std::string& name : commands()) {
    const ProgramResult result = run_walktrack({name, "--thread", "3"});
    EXPECT_EQ(result.exit_code, 2) << name;
    EXPECT_THAT(result.out, IsEmpty()) << name;
    EXPECT_THAT(result.err, HasSubstr("'--thread', did you mean '--threads'?")) << name;
  }
}

TEST(CommandLine, SaysItsVersionAndBuild) {
  const ProgramResult result = run_walktrack({"--version"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, MatchesRegex("walktrack [0-9.]+\ncommit [0-9a-z]+\nbuilt .+ by .+\n"));
}

// The version is stated in one place, from which the package takes it, too (apps/install.cmake).
TEST(CommandLine, ItsVersionIsThatOfTheProject) {
  const std::string project = read_file(WALKTRACK_SOURCE_DIR "/CMakeLists.txt");
  const std::string before = "project(walktrack VERSION ";
  const size_t begin = project.find(before) + before.size();
  const std::string version = project.substr(begin, project.find(' ', begin) - begin);
  EXPECT_THAT(run_walktrack({"--version"}).out, StartsWith("walktrack " + version + "\n"));
  EXPECT_THAT(run_walktrack({"--help-man"}).out, HasSubstr("\"walktrack " + version + "\""));
}

TEST(CommandLine, WithoutACommandShowsTheOverview) {
  const ProgramResult result = run_walktrack({});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, HasSubstr("Commands:"));
  EXPECT_THAT(result.err, IsEmpty());
}

// The program as `cmake --install` installs it: PREFIX/bin, and the demo in PREFIX/share.
TEST(CommandLine, InstalledItsExamplesNameTheInstalledDemo) {
  const TemporaryFolder prefix;
  namespace fs = std::filesystem;
  fs::create_directories(prefix / "bin");
  fs::create_directories(prefix / "share/walktrack/demo");
  fs::copy_file(WALKTRACK_BINARY, prefix / "bin/walktrack");
  const std::string demo = prefix / "share/walktrack/demo";
  for (const std::string& name : commands()) {
    const std::string help = run_program(prefix / "bin/walktrack", {name, "--help"}).out;
    for (const char* source : {" data/", "lib/", "build/"})
      EXPECT_THAT(help, Not(HasSubstr(source))) << name;
  }
  EXPECT_THAT(run_program(prefix / "bin/walktrack", {"track", "--help"}).out,
              HasSubstr("walktrack track " + demo + "/scene.yaml -o out/demo"));
  EXPECT_THAT(run_walktrack({"--help-man"}).out, Not(HasSubstr(" data/")));
}

struct Mistake {
  std::vector<std::string> words;
  int exit_code;
  std::string message;
};

TEST(CommandLine, NamesMistakes) {
  const std::vector<Mistake> mistakes{
      {{"confg"}, 2, "unknown command 'confg', did you mean 'config'?"},
      {{"fly"}, 2, "unknown command 'fly'; see 'walktrack --help'"},
      {{"--verison"}, 2, "unknown command '--verison'"},
      {{"config", "extra"}, 2, "unexpected word 'extra'"},
      {{"config", "--set"}, 2, "required argument for option '--set' is missing"},
      {{"config", "--set", "seed"}, 2, "--set: found 'seed', allowed: KEY=VALUE"},
      {{"config", "--set", "sed=3"}, 2, "sed: found an unknown key, did you mean 'seed'?"},
      {{"config", "--seed", "-1"}, 2, "--seed: seed: found '-1', allowed: a whole number from 0"},
      {{"config", "--threads", "many"}, 2, "--threads: threads: found 'many', allowed: a whole"},
      {{"config", "--quiet", "--verbose"}, 2, "--quiet and --verbose exclude each other"},
      {{"config", "-c", "/nowhere.yaml"}, 2, "/nowhere.yaml: no such file"},
      {{"config", "-o", "/nowhere/config.yaml"}, 1, "/nowhere/config.yaml"},
      {{"batch", "/nowhere", "-o", "/tmp/x"}, 3, "/nowhere: found no folder"},
      {{"batch", "/tmp", "-o", "/tmp/x", "--shard", "3/2"},
       2,
       "--shard: found '3/2', allowed: i/n"},
      {{"batch", "/tmp", "-o", "/tmp/x", "--jobs", "0"}, 2, "--jobs: found less than 1"},
      {{"batch", "/tmp"}, 2, "--output is missing"},
      {{"batch", "-o", "/tmp/x"}, 2, "FOLDER is missing, or --manifest"},
      {{"batch", "a", "--manifest", "b", "-o", "/tmp/x"}, 2, "FOLDER and --manifest exclude"},
      {{"batch", "--manifest", "/nowhere", "-o", "/tmp/x"}, 3, "/nowhere: cannot be read: No such"},
      {{"batch", "a", "--bids"}, 2, "--bids needs --scene"},
      {{"batch", "--bids", "--scene", "a", "--manifest", "b"}, 2, "--bids and --manifest exclude"},
      {{"batch", "/nowhere", "--bids", "--scene", "a"},
       3,
       "/nowhere: found no folder, allowed: a BIDS"},
      {{"batch", "a", "--steal", "--retry-failed", "-o", "/tmp/x"},
       2,
       "--steal and --retry-failed"},
      {{"batch", "/tmp", "-o", "/tmp/x", "--work", "/tmp/x/y"}, 2, "--work: found a folder in the"},
      {{"batch", "/tmp", "-o", "/tmp/x", "--resume", "-y"}, 2, "--resume and --yes exclude"},
      {{"calibrate"}, 2, "--output is missing"},
      {{"calibrate", "-o", "/tmp/x"}, 2, "--views"},
      {{"calibrate", "--model", "flat", "-o", "/tmp/x"}, 2, "found flat, allowed: pinhole, brown"},
      {{"calibrate", "--board", "letters"},
       2,
       "--board: found letters, allowed: chessboard, circles or"},
      {{"calibrate", "--size", "9by6"}, 2, "--size: found '9by6', allowed: COLUMNSxROWS"},
      {{"calibrate", "--size", "9x6"}, 2, "--spacing: found 0, allowed: metres between"},
      {{"calibrate", "--import", "a.pickle"}, 2, "--output is missing"},
      {{"calibrate", "--import", "a.pickle", "--views", "b"}, 2, "this option without --import"},
      {{"calibrate", "--image-size", "640x480"}, 2, "this option with --import"},
      {{"calibrate", "--import", "a.pickle", "--image-size", "640", "-o", "/tmp/x"},
       2,
       "--image-size: found '640', allowed: WIDTHxHEIGHT"},
      {{"calibrate", "--import", "a.cp", "-o", "/tmp/x"}, 3, ".qca.txt (Qualisys)"},
      {{"check"}, 2, "SCENE.yaml is missing"},
      {{"compare"}, 2, "GROUP is missing"},
      {{"compare", "/nowhere"}, 2, "--output is missing"},
      {{"compare", "/nowhere", "-o", "/tmp/x"}, 3, "/nowhere: found no such folder, allowed: res"},
      {{"compare", "a=", "-o", "/tmp/x"}, 2, "found 'a=', allowed: a folder, or NAME=FOLDER"},
      {{"compare", "a", "-o", "/tmp/x", "--unit", "days"}, 2, "--unit: found 'days', allowed: st"},
      {{"compare", "a", "-o", "/tmp/x", "--draws", "5"}, 2, "--draws: found 5, allowed: 100 to"},
      {{"init"}, 2, "VIDEO is missing"},
      {{"init", "a.mp4"}, 2, "--height is missing: the height of the subject in metres"},
      {{"init", "a.mp4", "--height", "175"}, 2, "--height: found 175, allowed: 0.5 to 2.5"},
      {{"init", "a.mp4", "--height", "1.7", "--fov-deg", "0"}, 2, "--fov-deg: found 0, allowed: 5"},
      {{"init", "a.mp4", "--height", "1.7"}, 2, "--output is missing"},
      {{"init", "/no.mp4", "--height", "1.7", "-o", "/nowhere/x"}, 3, "/no.mp4: found no file"},
      {{"plan"}, 2, "SCENE.yaml is missing"},
      {{"plan", "/nowhere.yaml"}, 3, "/nowhere.yaml: no such file"},
      {{"track", "x", "-o", "/tmp/x", "--fps", "0"},
       2,
       "--fps: found 0, allowed: a number above 0"},
      {{"track", "x", "-o", "/tmp/x", "--budget-ms", "-1"}, 2, "--budget-ms: found -1"},
      {{"track", "x", "-o", "/tmp/x", "--fps", "9", "--budget-ms", "9"}, 2, "exclude each other"},
      {{"init", "a.mp4", "--floor", "1,2,3"}, 2, "--floor: found '1,2,3', allowed: U1,V1,U2,V2,M"},
      {{"init", "a.mp4", "b.mp4", "--tilt-deg", "3"}, 2, "--tilt-deg"},
      {{"init", "a.mp4", "b.mp4", "--background", "c.mp4"}, 2, "found 1 values, allowed: none or"},
      {{"sweep", "/nowhere.yaml"}, 2, "--output is missing"},
      {{"sweep", "/nowhere.yaml", "-o", "/tmp/x"}, 3, "/nowhere.yaml: no such file"},
      {{"sweep", "x", "-o", "/tmp/x", "--seeds", "0"}, 2, "--seeds: found 0, allowed: a number"},
      {{"config", "-c", "fst"}, 2, "fst: found no such file, allowed: a file, or a preset: fast"},
      {{"check", "/nowhere.yaml"}, 3, "/nowhere.yaml: no such file"},
  };
  for (const Mistake& mistake : mistakes) {
    const ProgramResult result = run_walktrack(mistake.words);
    EXPECT_EQ(result.exit_code, mistake.exit_code) << mistake.message;
    EXPECT_THAT(result.out, IsEmpty()) << mistake.message;
    EXPECT_THAT(result.err, StartsWith("walktrack: ")) << mistake.message;
    EXPECT_THAT(result.err, HasSubstr(mistake.message));
  }
}

TEST(ConfigCommand, LaterSourcesWinAndAreNamed) {
  const TemporaryFolder folder;
  const std::string file = folder.write("fast.yaml", "# comment\nseed: 5\nthreads: 2\n");
  const ProgramResult result =
      run_walktrack({"config", "-c", file, "--set", "seed=6", "--seed", "7"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("from --seed\nseed: 7\n"));
  EXPECT_THAT(result.out, HasSubstr("from fast.yaml:3\nthreads: 2\n"));
}

TEST(ConfigCommand, ItsOutputIsAConfiguration) {
  const TemporaryFolder folder;
  const std::string file = folder / "all.yaml";
  ASSERT_EQ(run_walktrack({"config", "--set", "seed=9", "-o", file}).exit_code, 0);
  const ProgramResult changed = run_walktrack({"config", "-c", file});
  EXPECT_THAT(changed.out, HasSubstr("seed: 9\n"));
  const ProgramResult again = run_walktrack({"config", "-o", file});
  EXPECT_EQ(again.exit_code, 2);
  EXPECT_THAT(again.err, HasSubstr("-y overwrites"));
  EXPECT_EQ(run_walktrack({"config", "-o", file, "-y"}).exit_code, 0);
  EXPECT_THAT(read_file(file), HasSubstr("seed: 1\n"));
}

TEST(BatchCommand, GoesOnListsFailuresAndExitsWithOne) {
  const TemporaryFolder folder;
  folder.write("in/bad one/scene.yaml", "cameras: [");
  folder.write("in/other/scene.yaml", "camras: []\n");
  const std::string in = folder / "in", out = folder / "out";
  EXPECT_EQ(run_walktrack({"batch", in, "-o", out, "--list"}).out,
            "waiting\tbad one\nwaiting\tother\n");
  EXPECT_EQ(run_walktrack({"batch", in, "-o", out, "--dry-run"}).out, "bad one\nother\n");
  EXPECT_EQ(run_walktrack({"batch", in, "-o", out, "--dry-run", "--retry-failed"}).out, "");
  EXPECT_FALSE(std::filesystem::exists(out));
  const ProgramResult result = run_walktrack({"batch", in, "-o", out, "--jobs", "2"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("0 complete, 0 degraded, 2 failed, 0 left; see "));
  EXPECT_THAT(read_file(out + "/failures.txt"), StartsWith("bad one: exit "));
  EXPECT_THAT(read_file(out + "/failures.txt"), HasSubstr("\nother: exit "));
  EXPECT_EQ(run_walktrack({"batch", in, "-o", out, "--dry-run", "--retry-failed"}).out,
            "bad one\nother\n");
  const ProgramResult report = run_walktrack({"batch", in, "-o", out, "--report", "--json-line"});
  EXPECT_EQ(report.exit_code, 1);
  EXPECT_THAT(report.err, HasSubstr("0 complete, 0 degraded, 2 failed, 0 left"));
  EXPECT_THAT(report.out, HasSubstr("\"failed\":2"));
  EXPECT_EQ(run_walktrack({"batch", in, "-o", out + "2", "--report"}).exit_code, 3);
}

TEST(AnalyseCommand, RefusesSizesThatNobodyHas) {
  const TemporaryFolder folder;
  const std::string motion = std::string(WALKTRACK_SOURCE_DIR) + "/data/demo/truth.csv";
  for (const std::string command : {"analyse", "optimise"}) {
    const auto run = [&](const char* option, const char* value) {
      return run_walktrack({command, motion, "-o", folder / "out", option, value});
    };
    const ProgramResult tall = run("--height", "175"), heavy = run("--mass", "1e6");
    EXPECT_EQ(tall.exit_code, 2) << command;
    EXPECT_THAT(tall.err, HasSubstr("--height: found 175, allowed: 0.2 to 4"));
    EXPECT_EQ(heavy.exit_code, 2) << command;
    EXPECT_THAT(heavy.err, HasSubstr("--mass: found 1e+06, allowed: 0.5 to 1000"));
  }
}

class CalibrateCommand : public testing::Test {
 protected:
  ProgramResult run(const std::string& points) const {
    const std::string demo = std::string(WALKTRACK_SOURCE_DIR) + "/data/demo/";
    return run_walktrack({"calibrate", "--camera", demo + "side.yaml", "--points", points,
                          "--floor", demo + "side.mp4", "-o", out_});
  }
  const TemporaryFolder folder_;
  const std::string out_ = folder_ / "out";
};

TEST_F(CalibrateCommand, PlacesTheDemosCameraAndOverwritesOnlyWhenTold) {
  const std::string points = std::string(WALKTRACK_SOURCE_DIR) + "/data/demo/side_points.csv";
  const ProgramResult result = run(points);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("640x480 px"));
  EXPECT_TRUE(std::filesystem::exists(out_ + "/cam0.yaml"));
  EXPECT_EQ(run(points).exit_code, 2);
}

TEST_F(CalibrateCommand, UnreadableOrTooFewPointsAreInputThatEndsWithThree) {
  EXPECT_EQ(run("/nowhere.csv").exit_code, 3);
  const ProgramResult few = run(folder_.write("few.csv", "u,v,x,y,z\n10,20,0,0,0\n30,20,1,0,0\n"));
  EXPECT_EQ(few.exit_code, 3);
  EXPECT_THAT(few.err, HasSubstr("few.csv"));
  EXPECT_FALSE(std::filesystem::exists(out_ + "/cam0.yaml"));
}

}  // namespace
}  // namespace walktrack
