// `batch --work`: results appear complete in the output, whatever happens to the worker, with a
// small script in place of `walktrack track`.
#include "jobs/batch/workers/work_folder.h"

#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/errors.h"
#include "io/archive/files.h"
#include "jobs/batch/batch.h"
#include "jobs/batch/workers/batch_work.h"
#include "jobs/batch/workers/folder_move.h"
#include "tests/message_of.h"
#include "tests/run_program.h"

namespace walktrack {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

// Marks its outputs, leaves a checkpoint before it ends, and ends as the scene's second line
// states.
constexpr const char* kTracker =
    "#!/bin/sh\n"
    "scene=$1; out=$3; mode=$(sed -n 2p \"$scene\")\n"
    "printf '# x\\ncheckpoint.bin\\njoints.csv\\nrun.json\\n' > \"$out/.walktrack_track\"\n"
    "[ -f \"$out/checkpoint.bin\" ] && echo resumed >> \"$out/joints.csv\"\n"
    "echo x >> \"$SEEN\"; echo 1 > \"$out/checkpoint.bin\"\n"
    "case $mode in\n"
    "  '#fail') rm \"$out/checkpoint.bin\"; echo 'walktrack: bad' >&2; exit 3;;\n"
    "  '#slow') sleep 30;;\n"
    "esac\n"
    "echo t >> \"$out/joints.csv\"; mkdir -p \"$out/deep\"; echo d > \"$out/deep/file\"\n"
    "rm \"$out/checkpoint.bin\"; echo '{\"status\": \"tracked\"}' > \"$out/run.json\"\n";

class WorkFolder : public testing::Test {
 protected:
  WorkFolder() {
    const std::string script = folder_.write("track.sh", kTracker);
    fs::permissions(script, fs::perms::owner_all);
    setenv("SEEN", (folder_ / "seen").c_str(), 1);
    job_.folder = folder_.path() / "in";
    job_.output = folder_.path() / "out";
    job_.work = folder_.path() / "work";
    job_.command = {script};
    add("a/b", "ok");
  }
  void add(const std::string& name, const std::string& mode) const {
    folder_.write("in/" + name + "/scene.yaml", "cameras: []\n#" + mode + "\n");
  }
  size_t runs() const { return read_file(folder_ / "seen").size() / 2; }
  fs::path in_work(const std::string& name) const {
    return tracked_in(job_, {name, {}, job_.output / name});
  }
  // Starts a separate worker and kills it as soon as `file` exists.
  void kill_when_there(const fs::path& file) const {
    const pid_t worker = fork();
    if (worker == 0) {
      run_batch(job_, {});
      _exit(0);
    }
    while (!fs::exists(file)) usleep(1000);
    kill(worker, SIGKILL);
    waitpid(worker, nullptr, 0);
  }
  // Files below a folder, hidden ones, too; folders end in a slash.
  static std::vector<std::string> files(const fs::path& folder) {
    std::vector<std::string> out;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
      out.push_back(entry.path().lexically_relative(folder).string() +
                    (entry.is_directory() ? "/" : ""));
    std::sort(out.begin(), out.end());
    return out;
  }
  void expect_whole_result() const {
    EXPECT_THAT(files(job_.output / "a/b"),
                testing::ElementsAre(".walktrack_batch", ".walktrack_track", "deep/", "deep/file",
                                     "joints.csv", "log.txt", "run.json"));
    EXPECT_EQ(files(job_.output / "a").front(), "b/");  // nothing hidden remains beside it
    EXPECT_FALSE(fs::exists(in_work("a/b")));
  }
  TemporaryFolder folder_;
  BatchJob job_;
};

TEST_F(WorkFolder, ShowsWholeResultsOnly) {
  EXPECT_EQ(run_batch(job_, {}).complete, 1);
  expect_whole_result();
  EXPECT_EQ(run_batch(job_, {}).complete, 1);
  EXPECT_EQ(runs(), 1u);
}

TEST_F(WorkFolder, OnAnotherFileSystem) {
  const fs::path memory = "/dev/shm";
  std::error_code none;
  if (!fs::exists(memory, none)) GTEST_SKIP() << "no second file system";
  job_.work = new_folder(memory / "walktrack_test.");
  EXPECT_EQ(run_batch(job_, {}).complete, 1);
  expect_whole_result();
  const auto mode = fs::status(job_.output / "a/b").permissions();
  EXPECT_EQ(mode, fs::status(job_.output / "a").permissions());
  fs::remove_all(job_.work);
}

// Nothing of it is in the output; the next batch resumes from its checkpoint.
TEST_F(WorkFolder, TheTrackOfAKilledWorkerIsResumed) {
  add("a/b", "slow");
  kill_when_there(in_work("a/b") / "checkpoint.bin");
  EXPECT_FALSE(fs::exists(job_.output / "a/b"));
  add("a/b", "ok");
  EXPECT_EQ(run_batch(job_, {}).complete, 1);
  EXPECT_EQ(read_file(job_.output / "a/b/joints.csv"), "resumed\nt\n");
  expect_whole_result();
}

// Killed between the result's last file and its move to the output: nothing is tracked again.
TEST_F(WorkFolder, ACompleteResultIsOnlyMoved) {
  BatchJob elsewhere = job_;
  elsewhere.work.clear();
  run_batch(elsewhere, {});
  fs::create_directories(in_work("a"));
  fs::rename(job_.output / "a/b", in_work("a/b"));
  EXPECT_EQ(run_batch(job_, {}).complete, 1);
  EXPECT_EQ(runs(), 1u);
  expect_whole_result();
}

// Killed during a copy: the remains are removed, and were never at the place of a result.
TEST_F(WorkFolder, AnIncompleteCopyIsRemoved) {
  folder_.write("out/a/.walktrack_for.b/new.abc123/joints.csv", "half");
  folder_.write("out/a/.walktrack_for.b/.walktrack_claim", "elsewhere.1");
  fs::last_write_time(job_.output / "a/.walktrack_for.b/.walktrack_claim",
                      fs::file_time_type::clock::now() - std::chrono::seconds(100));
  EXPECT_EQ(run_batch(job_, {}).complete, 1);
  expect_whole_result();
}

TEST_F(WorkFolder, FailuresAreInTheOutput) {
  add("a/b", "fail");
  EXPECT_EQ(run_batch(job_, {}).failed, 1);
  EXPECT_EQ(read_file(job_.output / "a/b/failure.txt"), "exit 3: bad\n");
  EXPECT_EQ(read_file(job_.output / "a/b/log.txt"), "walktrack: bad\n");
  EXPECT_FALSE(fs::exists(in_work("a/b")));
  add("a/b", "ok");
  EXPECT_EQ(run_batch(job_, {}).complete, 1);
  expect_whole_result();
}

TEST_F(WorkFolder, FilesOfTheUserStayBesideTheResult) {
  folder_.write("out/a/b/notes.txt", "mine");
  EXPECT_EQ(run_batch(job_, {}).complete, 1);
  EXPECT_EQ(read_file(job_.output / "a/b/notes.txt"), "mine");
  EXPECT_EQ(read_file(job_.output / "a/b/joints.csv"), "t\n");
  EXPECT_TRUE(fs::exists(job_.output / "a/b/run.json"));
}

TEST_F(WorkFolder, AnEarlierResultIsReplacedWhenTheNewOneIsWhole) {
  run_batch(job_, {});
  folder_.write("out/a/b/failure.txt", "killed\n");
  folder_.write("out/a/b/joints.csv", "old");
  job_.overwrite = true;
  EXPECT_EQ(run_batch(job_, {}).complete, 1);
  EXPECT_EQ(read_file(job_.output / "a/b/joints.csv"), "t\n");
  expect_whole_result();
}

TEST_F(WorkFolder, ScenesOfATemplateAreThoseOfTheOutput) {
  fs::remove_all(job_.folder);
  folder_.write("in/walk.mp4", "");
  job_.scene_template = folder_.write("room.yaml", "cameras: [{name: c, video: x.mp4}]\n");
  EXPECT_EQ(run_batch(job_, {}).complete, 1);
  EXPECT_THAT(read_file(job_.output / "walk/scene.yaml"), HasSubstr(folder_ / "in/walk.mp4"));
  EXPECT_FALSE(fs::exists(hidden_folder(job_.output / "walk")));
}

TEST_F(WorkFolder, OutputsThatShareItDoNotMeet) {
  BatchJob other = job_;
  other.output = folder_.path() / "out2";
  EXPECT_NE(in_work("a/b"), tracked_in(other, {"a/b", {}, other.output / "a/b"}));
  other.output = folder_.path() / "out/../out";
  EXPECT_EQ(in_work("a/b"), tracked_in(other, {"a/b", {}, other.output / "a/b"}));
}

TEST_F(WorkFolder, RefusesOneInTheOutput) {
  for (const char* place : {"out", "out/work"}) {
    job_.work = folder_.path() / place;
    EXPECT_THAT(message_of<UsageError>([&] { run_batch(job_, {}); }),
                HasSubstr("--work: found a folder in the output"));
  }
}

TEST_F(WorkFolder, LinksInTheHiddenPlaceAreRefused) {
  folder_.write("mine/file", "mine");
  fs::create_directories(job_.output / "a");
  fs::create_directory_symlink(folder_.path() / "mine", job_.output / "a/.walktrack_for.b");
  EXPECT_THAT(message_of<UsageError>([&] { run_batch(job_, {}); }), HasSubstr("found a link"));
  EXPECT_EQ(read_file(folder_ / "mine/file"), "mine");
}

TEST(MoveFolder, TakesNeitherLinksNorPipes) {
  const TemporaryFolder folder;
  fs::create_directories(folder / "from");
  fs::create_directories(folder / "stage");
  if (!fs::exists("/dev/shm")) GTEST_SKIP() << "no second file system";
  const fs::path from = new_folder("/dev/shm/walktrack_test.");
  fs::create_symlink("/etc/passwd", from / "link");
  EXPECT_THROW(move_folder(from, folder / "to", folder / "stage", "run.json"), std::runtime_error);
  EXPECT_FALSE(fs::exists(folder / "to"));
  EXPECT_TRUE(fs::is_symlink(from / "link"));
  fs::remove_all(from);
}

}  // namespace
}  // namespace walktrack
