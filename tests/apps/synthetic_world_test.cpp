// Synthetic worlds from outside: `evaluate` measures scenes of `render`.
#include <filesystem>
#include <sstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/run_program.h"

namespace walktrack {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr const char* kSmall =
    "duration: 1\nframe_rate: 15\nsetting: studio\nbackground_frames: 2\n"
    "cameras: [{name: side, size: [160, 120]}]\n";

std::string small_gait() {
  std::ostringstream text;
  text << "gait: {speed: 1.2}\n" << kSmall;
  return text.str();
}

TEST(RenderCommand, TakesAGaitOrAResultFolderOrSaysWhatIsMissing) {
  const TemporaryFolder folder;
  const std::string gait = folder.write("gait.yaml", small_gait());
  const std::string plain = folder.write("plain.yaml", kSmall);
  EXPECT_EQ(run_walktrack({"render", "--options", gait, "-o", folder / "scene"}).exit_code, 0);
  EXPECT_TRUE(fs::exists(folder / "scene/kinetics.csv"));
  // A tracked result is a folder with joints.csv.
  folder.write("result/joints.csv", read_file(folder / "scene/truth.csv"));
  const ProgramResult again =
      run_walktrack({"render", folder / "result", "--options", plain, "-o", folder / "again"});
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(read_file(folder / "again/truth.csv"), read_file(folder / "scene/truth.csv"));
  EXPECT_FALSE(fs::exists(folder / "again/kinetics.csv"));  // a motion without forces
  const ProgramResult nothing =
      run_walktrack({"render", "--options", plain, "-o", folder / "nothing"});
  EXPECT_EQ(nothing.exit_code, 2);
  EXPECT_THAT(nothing.err, HasSubstr("'walk' or 'gait'"));
}

TEST(EvaluateCommand, PrintsATableOrJsonAndDrawsAPlot) {
  const TemporaryFolder folder;
  const std::string options = folder.write("gait.yaml", small_gait());
  ASSERT_EQ(run_walktrack({"render", "--options", options, "-o", folder / "scene"}).exit_code, 0);
  const std::string truth = folder / "scene/truth.csv", plot = folder / "errors.svg";
  const ProgramResult table = run_walktrack({"evaluate", truth, truth, "--plot", plot});
  EXPECT_EQ(table.exit_code, 0) << table.err;
  EXPECT_THAT(table.out, HasSubstr("| joint error (7 joints), mean, mm"));
  EXPECT_THAT(read_file(plot), HasSubstr("</svg>"));
  EXPECT_EQ(run_walktrack({"evaluate", truth, truth, "--plot", plot}).exit_code, 2);
  EXPECT_EQ(run_walktrack({"evaluate", truth, truth, "--plot", plot, "-y"}).exit_code, 0);
  const ProgramResult json = run_walktrack({"evaluate", truth, truth, "--json"});
  EXPECT_THAT(json.out, HasSubstr("\"error_procrustes_ltoe_mm\""));
}

}  // namespace
}  // namespace walktrack
