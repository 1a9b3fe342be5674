// The batch with a small script in place of `walktrack track`.
#include "jobs/batch/batch.h"

#include <atomic>
#include <fstream>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/errors.h"
#include "jobs/batch/batch_changes.h"
#include "jobs/batch/batch_sequences.h"
#include "jobs/batch/sequence_list.h"
#include "jobs/batch/workers/folder_lock.h"
#include "jobs/batch/workers/sequence_claim.h"
#include "tests/message_of.h"
#include "tests/run_program.h"

namespace walktrack {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

// Does what the scene's second line says: "ok", "lost", "fail", "crash", "slow", "lie".
constexpr const char* kScript =
    "#!/bin/sh\n"
    "scene=$1; out=$3; mode=$(sed -n 2p \"$scene\")\n"
    "echo x >> \"$out/runs\"\n"
    "case $mode in\n"
    "  '#ok') echo '{\"summary\": {\"both\": {\"speed_m_s\": {\"value\": 1.25}}}}' > "
    "\"$out/gait.json\"\n"
    "    touch \"$out/report.html\"\n"
    "    echo '{\"status\": \"tracked\", \"digest\": \"d1\", \"timing\": {\"seconds\": 1.5, "
    "\"cpu_seconds\": 20}, \"numbers\": {\"frame_rate\": 25, \"frames\": 50},"
    " \"quality\": [{\"name\": \"foot_slide_mm\", \"value\": 12}]}' > \"$out/run.json\";;\n"
    "  '#lost') echo '{\"status\": \"below gates\", \"notes\": [\"lost 40 %\"]}' > "
    "\"$out/run.json\"; exit 4;;\n"
    "  '#fail') echo 'walktrack: cam.mp4: found \"no\" <video>, allowed: one' >&2; exit 3;;\n"
    "  '#crash') kill -SEGV $$;;\n"
    "  '#slow') sleep 30;;\n"
    "  '#lie') exit 0;;\n"
    "esac\n";

class BatchTest : public testing::Test {
 protected:
  BatchTest() {
    const std::string script = folder_.write("track.sh", kScript);
    fs::permissions(script, fs::perms::owner_all);
    job_.folder = folder_.path() / "in";
    job_.output = folder_.path() / "out";
    job_.command = {script};
    fs::create_directory(job_.folder);
  }
  void add(const std::string& name, const std::string& mode) {
    const fs::path scene = fs::path("in") / name / "scene.yaml";
    folder_.write(scene.string(), std::string("cameras: []\n#").append(mode).append("\n"));
  }
  static std::string numbered(int i) { return std::string("s").append(std::to_string(i)); }
  // The names of the sequences that are to be tracked.
  std::vector<std::string> to_do() const {
    std::vector<std::string> names;
    each_to_do(job_, SequenceList(job_),
               [&](const Sequence& sequence) { names.push_back(sequence.name); });
    return names;
  }
  // The number of times that the script ran for a sequence.
  size_t runs(const std::string& name) const {
    return read_file(job_.output / name / "runs").size() / 2;
  }
  TemporaryFolder folder_;
  BatchJob job_;
};

TEST_F(BatchTest, FindsScenesInNaturalOrderOutsideTheOutput) {
  add("trial10", "ok");
  add("trial9", "ok");
  folder_.write("in/a/walker.yaml", "# note\ncameras: [{name: c, video: c.mp4}]\n");
  folder_.write("in/a/render.yaml", "walk: {speed: 1}\ncameras: [{name: c, distance: 5}]\n");
  folder_.write("in/a/scene_one.yaml", "broken: [");
  folder_.write("in/a/cam.yaml", "image_width: 3\n");
  folder_.write("in/out/x/scene.yaml", "cameras: []\n");
  fs::create_directory_symlink(job_.folder, job_.folder / "loop");
  std::vector<std::string> names;
  for (const Sequence& found : find_sequences(job_.folder, job_.folder / "out")) {
    names.push_back(found.name);
    EXPECT_TRUE(found.scene.is_absolute());
  }
  EXPECT_THAT(names, ElementsAre("a/scene_one", "a/walker", "trial9", "trial10"));
  EXPECT_THROW(find_sequences(folder_ / "none", job_.output), InputError);
}

TEST_F(BatchTest, GoesOnAfterFailuresOfEveryKind) {
  for (const char* mode : {"ok", "lost", "fail", "crash", "lie"}) add(mode, mode);
  job_.jobs = 3;
  const BatchOutcome outcome = run_batch(job_, {});
  EXPECT_EQ(outcome.complete, 1);
  EXPECT_EQ(outcome.degraded, 1);
  EXPECT_EQ(outcome.failed, 3);
  EXPECT_EQ(outcome.waiting, 0);
  EXPECT_EQ(outcome.cpu_seconds, 20);
  EXPECT_EQ(outcome.video_seconds, 2);
  EXPECT_EQ(read_file(job_.output / "summary.csv"),
            "sequence,state,seconds,digest,reason,lost_percent,speed_m_s,cadence_steps_per_min,"
            "step_length_m,stance_percent,foot_slide_mm,penetration_mm,"
            "cpu_seconds_per_video_second\n"
            "crash,failed,,,ended by signal 11 (Segmentation fault),,,,,,,,\n"
            "fail,failed,,,\"exit 3: cam.mp4: found \"\"no\"\" <video>, allowed: one\",,,,,,,,\n"
            "lie,failed,,,exit 0,,,,,,,,\n"
            "lost,degraded,,,below gates: lost 40 %,,,,,,,,\n"
            "ok,complete,1.5,d1,,,1.250000,,,,12.000000,,10.00\n");
  EXPECT_THAT(read_file(job_.output / "failures.txt"),
              testing::StartsWith("crash: ended by signal 11 (Segmentation fault)\nfail: exit 3"));
  const std::string page = read_file(job_.output / "batch.html");
  EXPECT_THAT(page, HasSubstr("1 of 5 sequences complete"));
  EXPECT_THAT(page, HasSubstr("href=\"ok/report.html\""));
  EXPECT_THAT(page, HasSubstr("href=\"crash/\""));
  EXPECT_THAT(page, HasSubstr("<td class=\"number\">1.25</td>"));
  EXPECT_THAT(page, testing::Not(HasSubstr("<!--")));
  EXPECT_THAT(page, HasSubstr("&lt;video&gt;"));
  EXPECT_THAT(page, testing::Not(HasSubstr("<video>")));
}

TEST_F(BatchTest, RunAgainItDoesOnlyWhatIsNotComplete) {
  for (const char* mode : {"ok", "lost", "fail"}) add(mode, mode);
  run_batch(job_, {});
  add("fail", "ok");  // repaired
  const BatchOutcome outcome = run_batch(job_, {});
  EXPECT_EQ(outcome.complete, 2);
  EXPECT_EQ(outcome.failed, 0);
  EXPECT_EQ(runs("ok"), 1u);
  EXPECT_EQ(runs("lost"), 1u);
  EXPECT_EQ(runs("fail"), 2u);
  EXPECT_EQ(read_file(job_.output / "failures.txt"), "");
  job_.overwrite = true;
  EXPECT_THAT(to_do(), testing::IsEmpty());
}

// A result that could not be made again is tracked again, beside the earlier result.
TEST_F(BatchTest, DoesAgainWhatFailedBesideAnOldResult) {
  for (const char* name : {"kept", "lost"}) add(name, "ok");
  run_batch(job_, {});
  folder_.write("out/lost/failure.txt", "killed\n");
  for (const bool retry : {false, true}) {
    BatchJob job = job_;
    (retry ? job.retry_failed : job.overwrite) = true;
    const size_t before = runs("lost");
    EXPECT_EQ(run_batch(job, {}).complete, 2);
    EXPECT_EQ(runs("lost"), before + 1);
    EXPECT_EQ(runs("kept"), 1u);
    folder_.write("out/lost/failure.txt", "killed\n");
  }
}

TEST_F(BatchTest, RetriesNoneButThoseThatFailed) {
  for (const char* mode : {"ok", "lost", "fail"}) add(mode, mode);
  run_batch(job_, {});
  add("new", "ok");
  add("fail", "ok");  // repaired
  job_.retry_failed = true;
  EXPECT_THAT(to_do(), ElementsAre("fail"));
  const BatchOutcome outcome = run_batch(job_, {});
  EXPECT_EQ(outcome.complete, 2);
  EXPECT_EQ(outcome.waiting, 1);
  EXPECT_EQ(runs("fail"), 2u);
  EXPECT_EQ(runs("ok"), 1u);
  EXPECT_FALSE(fs::exists(job_.output / "new"));
  EXPECT_THAT(to_do(), testing::IsEmpty());
}

TEST_F(BatchTest, ClearsWhatAWorkerLeftThatWasKilledOverTheSummary) {
  add("a", "ok");
  run_batch(job_, {});
  folder_.write("out/summary.csv.7112345.tmp", "half");
  for (const char* name : {"notes.tmp", "backup.2024.tmp", "probe.txt", "stale.txt", "claim"})
    folder_.write(std::string("out/") + name, "mine");
  run_batch(job_, {});
  EXPECT_FALSE(fs::exists(job_.output / "summary.csv.7112345.tmp"));
  for (const char* name : {"notes.tmp", "backup.2024.tmp", "probe.txt", "stale.txt", "claim"})
    EXPECT_EQ(read_file(job_.output / name), "mine") << name;
  EXPECT_FALSE(fs::exists(job_.output / FolderLock::kFile));
}

TEST_F(BatchTest, ShardsCoverEverySequenceOnce) {
  for (int i = 0; i < 7; ++i) add(numbered(i), "ok");
  const auto all = find_sequences(job_.folder, job_.output);
  for (job_.shards = 3, job_.shard = 1; job_.shard <= 3; ++job_.shard) run_batch(job_, {});
  for (const Sequence& sequence : all) {
    EXPECT_EQ(runs(sequence.name), 1u) << sequence.name;
  }
}

TEST_F(BatchTest, EndsWhatTakesTooLong) {
  add("slow", "slow");
  add("ok", "ok");
  job_.limits.seconds = 6;  // a correct one takes milliseconds, with sanitizers a second
  const BatchOutcome outcome = run_batch(job_, {});
  EXPECT_EQ(outcome.complete, 1);
  EXPECT_EQ(outcome.failed, 1);
  EXPECT_EQ(read_file(job_.output / "failures.txt"), "slow: took longer than 6 s\n");
}

TEST_F(BatchTest, StopsWhenAskedAndLeavesTheRestWaiting) {
  add("a", "slow");
  add("b", "ok");
  std::atomic<bool> stop{false};
  std::thread asker([&] {
    while (!fs::exists(job_.output / "a/runs")) std::this_thread::yield();
    stop = true;
  });
  const BatchOutcome outcome = run_batch(job_, {.stop_request = &stop});
  asker.join();
  EXPECT_TRUE(outcome.interrupted);
  EXPECT_EQ(outcome.waiting, 2);
  EXPECT_FALSE(fs::exists(job_.output / "a/failure.txt"));
  EXPECT_FALSE(fs::exists(hidden_folder(job_.output / "a")));
}

// A worker that begins after another one has failed at a sequence counts that as an earlier
// attempt, like a batch that is run again; no complete sequence is tracked twice.
TEST_F(BatchTest, TwoWorkersNeverDoOneSequenceTwice) {
  for (int i = 0; i < 12; ++i) add(numbered(i), i % 3 == 0 ? "fail" : "ok");
  job_.jobs = 2;
  std::thread other([&] { run_batch(job_, {}); });
  run_batch(job_, {});
  other.join();
  for (int i = 0; i < 12; ++i) {
    EXPECT_GE(runs(numbered(i)), 1u) << i;
    EXPECT_LE(runs(numbered(i)), i % 3 == 0 ? 2u : 1u) << i;
  }
}

// A worker that has finished its share takes sequences that nobody has begun, tracked or failed at.
TEST_F(BatchTest, StealsWhatNobodyHasBegunOfOtherShares) {
  for (int i = 0; i < 9; ++i) add(numbered(i), "ok");
  add("s1", "fail");
  job_.shards = 3;
  job_.shard = 2;  // s1, s4, s7
  EXPECT_EQ(run_batch(job_, {}).failed, 1);
  const auto claim = SequenceClaim::try_take(job_.output / "s5");
  job_.shard = 1;
  job_.steal = true;
  const BatchOutcome outcome = run_batch(job_, {});
  EXPECT_EQ(outcome.complete, 3);  // counts are those of its own share
  EXPECT_EQ(outcome.stolen, 2);    // s2, s8
  for (int i = 0; i < 9; ++i) EXPECT_EQ(runs(numbered(i)), i == 5 ? 0u : 1u) << i;
}

// However late the others begin, all sequences are tracked, and none twice.
TEST_F(BatchTest, WorkersThatStealDoEverySequenceOnce) {
  for (int i = 0; i < 15; ++i) add(numbered(i), "ok");
  std::vector<BatchJob> jobs(3, job_);
  std::vector<std::thread> workers;
  for (size_t i = 0; i < 3; ++i) {
    jobs[i].shard = static_cast<int>(i) + 1;
    jobs[i].shards = 3;
    jobs[i].steal = true;
    workers.emplace_back([&jobs, i] { run_batch(jobs[i], {}); });
  }
  for (std::thread& worker : workers) worker.join();
  for (int i = 0; i < 15; ++i) EXPECT_EQ(runs(numbered(i)), 1u) << i;
}

TEST_F(BatchTest, LeavesClaimedSequencesAlone) {
  add("mine", "ok");
  add("theirs", "ok");
  const auto claim = SequenceClaim::try_take(job_.output / "theirs");
  const BatchOutcome outcome = run_batch(job_, {});
  EXPECT_EQ(outcome.complete, 1);
  EXPECT_EQ(outcome.waiting, 1);
  EXPECT_EQ(outcome.elsewhere, 1);
  EXPECT_TRUE(claim->is_held());
}

TEST_F(BatchTest, ClearsTheClaimOfAWorkerKilledAfterItsLastFile) {
  add("done", "ok");
  run_batch(job_, {});
  const fs::path claim = hidden_folder(job_.output / "done") / FolderLock::kFile;
  fs::create_directory(claim.parent_path());
  std::ofstream(claim) << "elsewhere.1";
  EXPECT_EQ(run_batch(job_, {}).complete, 1);
  EXPECT_TRUE(fs::exists(claim));  // it may be alive
  fs::last_write_time(claim, fs::file_time_type::clock::now() - std::chrono::seconds(100));
  EXPECT_EQ(run_batch(job_, {}).complete, 1);
  EXPECT_FALSE(fs::exists(claim.parent_path()));
}

TEST_F(BatchTest, MakesAScenePerVideoFromATemplate) {
  folder_.write("in/a/walk2.mp4", "");
  folder_.write("in/a/walk10.mp4", "");
  folder_.write("in/b.mp4", "");
  folder_.write("in/b.mov", "");
  job_.scene_template = folder_.write("room.yaml", "cameras: [{name: c, video: x.mp4}]\n");
  // The template has no second line that the script knows, so that nothing is complete.
  EXPECT_EQ(run_batch(job_, {}).failed, 4);
  for (const char* name : {"a/walk2", "a/walk10", "b.mp4", "b.mov"}) {
    EXPECT_THAT(read_file(job_.output / name / "scene.yaml"), HasSubstr("/in/")) << name;
    EXPECT_EQ(runs(name), 1u) << name;
  }
  job_.scene_template = folder_.write("two.yaml", "cameras: [{name: c}, {name: d}]\n");
  EXPECT_THROW(run_batch(job_, {}), InputError);
}

TEST_F(BatchTest, RefusesAFolderWithoutSequences) { EXPECT_THROW(run_batch(job_, {}), UsageError); }

// Files that no batch wrote are the user's, in any folder.
TEST_F(BatchTest, RefusesToOverwriteWhatIsNotItsOwn) {
  add("a", "ok");
  for (const char* name : {"summary.csv", "batch.html", "a/log.txt", "a/failure.txt"}) {
    folder_.write(std::string("out/") + name, "mine");
    for (const bool overwrite : {false, true}) {
      job_.overwrite = overwrite;
      EXPECT_THAT(message_of<UsageError>([&] { run_batch(job_, {}); }),
                  HasSubstr("a file that 'walktrack batch' has not marked as its own"))
          << name;
    }
    EXPECT_EQ(read_file(job_.output / name), "mine");
    EXPECT_EQ(runs("a"), 0u);
    fs::remove(job_.output / name);
  }
  run_batch(job_, {});
  EXPECT_EQ(runs("a"), 1u);
}

TEST_F(BatchTest, RefusesTheFolderOfItsScenes) {
  add("a", "ok");
  job_.output = job_.folder;
  EXPECT_THAT(message_of<UsageError>([&] { run_batch(job_, {}); }),
              HasSubstr("which the command reads"));
  EXPECT_FALSE(fs::exists(job_.folder / "batch.html"));
  EXPECT_FALSE(fs::exists(job_.folder / "a/log.txt"));
}

TEST(ChangedResults, AreNamedOnceAndNotByTheThousand) {
  ChangedResults changed;
  changed.add("a", "seed 1 -> 2");
  changed.add("b", "x.mp4 has changed");
  changed.add("c", "seed 1 -> 2");
  EXPECT_EQ(changed.text(), "\n  seed 1 -> 2: a, c\n  x.mp4 has changed: b");
  for (int i = 0; i < 1000; ++i) changed.add("more", "seed 1 -> 2");
  EXPECT_THAT(changed.text(), HasSubstr("more, more and 982 more\n"));
  for (int i = 0; i < 1000; ++i) changed.add("own", std::to_string(i));
  EXPECT_THAT(changed.text(), HasSubstr("\n  and 902 for other reasons"));
  EXPECT_EQ(changed.count(), 2003);
}

}  // namespace
}  // namespace walktrack
