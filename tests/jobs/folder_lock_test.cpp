#include "jobs/batch/workers/folder_lock.h"

#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <string_view>

#include <gtest/gtest.h>

#include "tests/run_program.h"

namespace walktrack {
namespace {

namespace fs = std::filesystem;

TEST(FolderLock, IsGivenToOneAndBack) {
  const TemporaryFolder folder;
  {
    const auto first = FolderLock::try_take(folder.path());
    ASSERT_TRUE(first);
    first->renew();
    EXPECT_FALSE(FolderLock::try_take(folder.path()));
  }
  EXPECT_TRUE(FolderLock::try_take(folder.path()));
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(FolderLock, OfADeadWorkerIsTakenOver) {
  const TemporaryFolder folder;
  const std::string file = folder.write(FolderLock::kFile, "elsewhere.1");
  fs::last_write_time(file, fs::file_time_type::clock::now() - std::chrono::seconds(100));
  EXPECT_FALSE(FolderLock::try_take(folder.path(), 200));
  EXPECT_TRUE(FolderLock::try_take(folder.path(), 60));
}

// A full disk is not taken for another worker for which the batch would wait.
TEST(FolderLock, ThatCannotBeWrittenIsAnError) {
  const TemporaryFolder folder;
  const pid_t worker = ::fork();
  if (worker == 0) {
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit none{0, 0};
    ::setrlimit(RLIMIT_FSIZE, &none);
    try {
      FolderLock::try_take(folder.path());
    } catch (const std::exception& error) {
      _exit(std::string_view(error.what()).ends_with("File too large") ? 0 : 1);
    }
    _exit(2);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(worker, &status, 0), worker);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(FolderLock, OfAKilledProcessOfThisMachineIsTakenOverAtOnce) {
  const TemporaryFolder folder;
  folder.write(".walktrack_stale.elsewhere.1",
               "");  // of one that was killed during a takeover
  const pid_t worker = fork();
  if (worker == 0) _exit(FolderLock::try_take(folder.path()) ? 0 : 1);  // and does not release it
  int status = 0;
  ASSERT_EQ(waitpid(worker, &status, 0), worker);
  ASSERT_EQ(status, 0);
  EXPECT_TRUE(fs::exists(folder / FolderLock::kFile));
  EXPECT_TRUE(FolderLock::try_take(folder.path()));
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

}  // namespace
}  // namespace walktrack
