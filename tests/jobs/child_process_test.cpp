#include "jobs/batch/workers/child_process.h"

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/run_program.h"

namespace walktrack {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

TEST(ChildProcess, LimitsMemory) {
  const TemporaryFolder folder;
  // dd needs its whole block in memory.
  ChildProcess child({"/bin/dd", "if=/dev/zero", "of=/dev/null", "bs=300M", "count=1"},
                     folder.path() / "log", {.memory_mb = 100});
  std::optional<ChildEnd> end;
  while (!(end = child.poll())) std::this_thread::yield();
  EXPECT_NE(end->exit_code, 0);
  EXPECT_THAT(read_file(folder.path() / "log"), HasSubstr("memory"));
}

TEST(ChildProcess, WritesANewLogAndFollowsNoLink) {
  const TemporaryFolder folder;
  const std::string mine = folder.write("mine", "mine");
  fs::create_symlink(mine, folder.path() / "link");
  fs::create_hard_link(mine, folder.path() / "same");
  fs::create_symlink(folder / "nowhere", folder.path() / "dangling");
  for (const char* log : {"mine", "link", "same", "dangling"})
    EXPECT_THROW(ChildProcess({"/bin/echo", "theirs"}, folder.path() / log, {}), std::runtime_error)
        << log;
  EXPECT_EQ(read_file(mine), "mine");
  EXPECT_FALSE(fs::exists(folder / "nowhere"));
}

TEST(ChildProcess, SaysWhenThereIsNoProgram) {
  const TemporaryFolder folder;
  ChildProcess child({"/nowhere/track"}, folder.path() / "log", {});
  std::optional<ChildEnd> end;
  while (!(end = child.poll())) std::this_thread::yield();
  EXPECT_EQ(end->exit_code, 127);
}

}  // namespace
}  // namespace walktrack
