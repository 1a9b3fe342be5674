#include "io/archive/result_folder.h"

#include <gtest/gtest.h>

#include "core/errors.h"
#include "tests/run_program.h"

namespace walktrack {
namespace {

namespace fs = std::filesystem;

TEST(ResultFolder, IsCompleteOnlyAfterFinish) {
  const TemporaryFolder folder;
  const fs::path out = folder.path() / "a/b";
  const ResultFolder result(out, false);
  result.write("joints.csv", "t\n");
  EXPECT_FALSE(is_complete_result(out));
  result.finish("{}");
  EXPECT_TRUE(is_complete_result(out));
  EXPECT_EQ(read_file(out / "joints.csv"), "t\n");
}

TEST(ResultFolder, RefusesACompleteResultUnlessTold) {
  const TemporaryFolder folder;
  ResultFolder(folder.path(), false).finish("{}");
  EXPECT_THROW(ResultFolder(folder.path(), false), UsageError);
  EXPECT_TRUE(is_complete_result(folder.path()));
  const ResultFolder again(folder.path(), true);
  EXPECT_FALSE(is_complete_result(folder.path()));
}

TEST(ResultFolder, ClearsWhatAKilledRunLeftAndNothingElse) {
  const TemporaryFolder folder;
  for (const char* name : {"joints.csv", "run.json.71.tmp", "overlay_a.part.mp4"}) {
    folder.write(name, "half");
  }
  for (const char* name : {"notes.tmp", "a..tmp", "mine.csv"}) folder.write(name, "kept");
  const ResultFolder again(folder.path(), false);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 3);
  EXPECT_TRUE(fs::exists(folder / "notes.tmp"));
}

TEST(ResultFolder, APartialResultMayBeDoneAgain) {
  const TemporaryFolder folder;
  ResultFolder(folder.path(), false).finish_partial("{}");
  EXPECT_FALSE(is_complete_result(folder.path()));
  EXPECT_TRUE(fs::exists(folder / "run.partial.json"));
  ResultFolder(folder.path(), false).finish("{}");
  EXPECT_TRUE(is_complete_result(folder.path()));
  EXPECT_FALSE(fs::exists(folder / "run.partial.json"));
}

TEST(ResultFolder, ClearsWhatAnEarlierRunLeftAndNothingElse) {
  const TemporaryFolder folder;
  folder.write("overlay_old.mp4", "x");
  folder.write("joints.csv", "x");
  folder.write("thesis.txt", "x");
  folder.write("overlay_notes.txt", "x");
  const ResultFolder result(folder.path(), false);
  EXPECT_FALSE(fs::exists(folder / "overlay_old.mp4"));
  EXPECT_FALSE(fs::exists(folder / "joints.csv"));
  EXPECT_TRUE(fs::exists(folder / "thesis.txt"));
  EXPECT_TRUE(fs::exists(folder / "overlay_notes.txt"));
}

TEST(ResultFolder, RefusesAFile) {
  const TemporaryFolder folder;
  EXPECT_THROW(ResultFolder(folder.write("f", ""), true), UsageError);
}

}  // namespace
}  // namespace walktrack
