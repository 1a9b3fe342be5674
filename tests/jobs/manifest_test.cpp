// Lists of sequences, alone and in a batch with a small script in place of `walktrack track`.
#include "jobs/batch/manifest.h"

#include <algorithm>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/errors.h"
#include "jobs/batch/batch.h"
#include "jobs/batch/batch_report.h"
#include "jobs/batch/sequence_list.h"
#include "tests/message_of.h"
#include "tests/run_program.h"
#include "tests/sanitized.h"

namespace walktrack {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

class ManifestTest : public testing::Test {
 protected:
  std::string write(const std::string& text) const { return folder_.write("list.txt", text); }
  static std::vector<std::string> names(const Manifest& manifest) {
    std::vector<std::string> out;
    Manifest::Reader reader(manifest);
    while (reader.advance()) out.push_back(reader.row().name);
    return out;
  }
  std::string trouble(const std::string& text) const {
    return message_of<InputError>([&] { Manifest(write(text), false); });
  }
  TemporaryFolder folder_;
};

TEST_F(ManifestTest, ReadsPathsFromItsFolderAndNamesThemAsFoldersAre) {
  const std::string file = write(
      "\xEF\xBB\xBF# a comment\r\n"
      "\n"
      "monday/t1/scene.yaml\r\n"
      "   \n"
      "monday/t2.yaml\n"
      " # not a path\n"
      "./scene.yaml\n"
      "/data/x y/scene.yaml\n" +
      (folder_ / "below/scene.yaml") +
      "\n"
      "../elsewhere/scene.yaml\tother/one");
  const Manifest manifest(file, false);
  EXPECT_EQ(manifest.size(), 6u);
  EXPECT_THAT(names(manifest),
              ElementsAre("monday/t1", "monday/t2", "scene", "data/x y", "below", "other/one"));
  Manifest::Reader reader(manifest);
  ASSERT_TRUE(reader.advance());
  EXPECT_EQ(reader.row().file, folder_ / "monday/t1/scene.yaml");
  EXPECT_EQ(reader.line_number(), 3);
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(reader.advance());
  EXPECT_EQ(reader.row().file, folder_.path().parent_path() / "elsewhere/scene.yaml");
  EXPECT_FALSE(reader.advance());
  EXPECT_FALSE(reader.advance());
}

TEST_F(ManifestTest, OfVideosNamesLoseTheirEnding) {
  const Manifest manifest(write("a/walk.mp4\nb/walk.mov\tb\n"), true);
  EXPECT_THAT(names(manifest), ElementsAre("a/walk", "b"));
}

TEST_F(ManifestTest, SaysWhichLineIsWrongAndWhatIsAllowed) {
  EXPECT_THAT(trouble("a.yaml\nb.yaml\tx\ty\n"), HasSubstr("list.txt:2: found more than two col"));
  EXPECT_THAT(trouble("\tname\n"), HasSubstr(":1: found a row that begins with a tab"));
  EXPECT_THAT(
      trouble("# x\n../a/scene.yaml\n"),
      HasSubstr(":2: found '../a/scene.yaml', which makes a name with a part with a leading "
                "dot, allowed: a name in a second column"));
  for (const char* name : {"", "/abs", "a//b", "../x", ".hidden", "a/..", "a/", "a\x01"})
    EXPECT_THAT(trouble(std::string("a.yaml\t") + name + "\n"), HasSubstr(":1: found the name '"))
        << name;
  EXPECT_THAT(trouble("a.yaml\t" + std::string(201, 'n')), HasSubstr("more than 200 bytes"));
  EXPECT_THAT(trouble(std::string("a\0b\n", 4)), HasSubstr(":1: found a zero byte"));
  EXPECT_THAT(trouble("a\n" + std::string(100'000, 'x')), HasSubstr(":2: found a line of more"));
  EXPECT_THAT(trouble("a\n" + std::string(17'000, 'x') + "\n"), HasSubstr(":2: found a line of"));
  EXPECT_THAT(trouble("a/scene.yaml\nb.yaml\tx\n\na/scene.yaml\n"),
              HasSubstr("list.txt:4: found 'a', which is the name of line 1, too"));
  EXPECT_THAT(trouble("a/scene.yaml\nb.yaml\ta\n"), HasSubstr(":2: found 'a', which is the name"));
  EXPECT_THAT(message_of<InputError>([] { Manifest("/nowhere.txt", false); }),
              HasSubstr("/nowhere.txt: cannot be read: No such file"));
  EXPECT_THAT(message_of<InputError>([&] { Manifest(folder_.path().string(), false); }),
              HasSubstr("found a folder, allowed: a list of scenes"));
}

// A pipe can be read only once, but the list is read several times.
TEST_F(ManifestTest, ReadsPipes) {
  const ProgramResult ran = run_program(
      "/bin/bash", {"-c",
                    "cd \"$0\" && printf 'a.yaml\\nsub/b.yaml\\n' | \"$1\" batch --manifest - "
                    "-o out --list && \"$1\" batch --manifest <(echo c.yaml) -o out --list",
                    folder_.path().string(), WALKTRACK_BINARY});
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_EQ(ran.out.substr(0, 26), "waiting\ta\nwaiting\tsub/b\n" + ran.out.substr(24, 2));
  EXPECT_THAT(ran.out, HasSubstr("waiting\t"));
}

class ManifestBatch : public ManifestTest {
 protected:
  ManifestBatch() {
    const std::string script =
        folder_.write("track.sh",
                      "#!/bin/sh\nout=$3; echo \"$1\" >> \"$out/ran\"\n"
                      "[ -f \"$1\" ] || { echo \"walktrack: $1: no such file\" >&2; exit 3; }\n"
                      "echo '{\"status\": \"tracked\"}' > \"$out/run.json\"\n");
    fs::permissions(script, fs::perms::owner_all);
    job_.output = folder_.path() / "out";
    job_.command = {script};
    job_.manifest = folder_ / "list.txt";
  }
  BatchJob job_;
};

TEST_F(ManifestBatch, DoesItsRowsAndNoOthers) {
  for (const char* name : {"a", "b", "c"}) folder_.write(std::string(name) + "/scene.yaml", "");
  write("a/scene.yaml\nb/scene.yaml\tother/b\nmissing/scene.yaml\n");
  const BatchOutcome outcome = run_batch(job_, {});
  EXPECT_EQ(outcome.complete, 2);
  EXPECT_EQ(outcome.failed, 1);
  EXPECT_EQ(read_file(job_.output / "other/b/ran"), folder_ / "b/scene.yaml\n");
  EXPECT_FALSE(fs::exists(job_.output / "c"));
  EXPECT_THAT(read_file(job_.output / "failures.txt"), HasSubstr("missing: exit 3: "));
  EXPECT_EQ(run_batch(job_, {}).complete, 2);
  EXPECT_EQ(read_file(job_.output / "a/ran"), folder_ / "a/scene.yaml\n");
}

TEST_F(ManifestBatch, AReportNeedsTheFolderOfABatch) {
  folder_.write("0/scene.yaml", "");
  write("0/scene.yaml\n");
  EXPECT_THAT(message_of([&] { write_batch_reports(job_, SequenceList(job_)); }),
              HasSubstr("found no folder, allowed: the output folder of a batch that has begun"));
  EXPECT_FALSE(fs::exists(job_.output));
}

TEST_F(ManifestBatch, SharesCoverEveryRowOnceAndLeaveTheSummaryToTheReport) {
  std::string list;
  for (int i = 0; i < 7; ++i) {
    const std::string scene = std::to_string(i) + "/scene.yaml";
    folder_.write(scene, "");
    list += scene + "\n# between\n";
  }
  write(list);
  for (job_.shards = 3, job_.shard = 1; job_.shard <= 3; ++job_.shard) run_batch(job_, {});
  for (int i = 0; i < 7; ++i)
    EXPECT_EQ(read_file(job_.output / std::to_string(i) / "ran").find('\n') + 1,
              read_file(job_.output / std::to_string(i) / "ran").size())
        << i;
  EXPECT_FALSE(fs::exists(job_.output / "summary.csv"));
  EXPECT_EQ(write_batch_reports(job_, SequenceList(job_)).complete, 7);
  EXPECT_TRUE(fs::exists(job_.output / "summary.csv"));
}

TEST_F(ManifestBatch, MakesAScenePerVideoOfATemplate) {
  job_.scene_template = folder_.write("room.yaml", "cameras: [{name: c, video: x.mp4}]\n");
  write("a/walk.mp4\n/elsewhere/walk.mp4\tb\n");
  EXPECT_EQ(run_batch(job_, {}).complete, 2);
  EXPECT_THAT(read_file(job_.output / "a/walk/scene.yaml"), HasSubstr(folder_ / "a/walk.mp4"));
  EXPECT_THAT(read_file(job_.output / "b/scene.yaml"), HasSubstr("/elsewhere/walk.mp4"));
}

TEST_F(ManifestBatch, RefusesAnEmptyListAndOneInItsOutput) {
  write("# nothing\n");
  EXPECT_THAT(message_of<UsageError>([&] { run_batch(job_, {}); }),
              HasSubstr("found no sequence, allowed: paths of scenes"));
  job_.manifest = folder_.write("out/list.txt", "a.yaml\n");
  EXPECT_THAT(message_of<UsageError>([&] { run_batch(job_, {}); }),
              HasSubstr("'list.txt', which the command reads"));
}

// Long lists, as on clusters, in memory that does not depend on their length.
TEST(LongManifest, AMillionRowsAreListedInLittleMemory) {
  constexpr int kRows = 1'000'000;
  const TemporaryFolder folder;
  const std::string file = folder / "list.txt";
  {
    std::ofstream list(file);
    for (int i = 0; i < kRows; ++i)
      list << "site" << i % 17 << "/subject" << i / 100 << "/trial" << i << "/scene.yaml\n";
  }
  // Measured while it runs: the peak of a child process includes the memory of this test.
  const auto list = [&](const std::string& more) {
    const std::string line = "\"$0\" batch --manifest \"$1\" -o \"$2\" --list " + more +
                             " > \"$3\" & while peak=$(grep VmHWM /proc/$!/status); do echo "
                             "\"$peak\" > \"$4\"; sleep 0.02; done; wait $!";
    StartedProgram program("/bin/sh", {"-c", line, WALKTRACK_BINARY, file, folder / "out",
                                       folder / "listed", folder / "peak"});
    EXPECT_EQ(program.wait(), 0);
    const std::string peak = read_file(folder / "peak");  // "VmHWM: 41234 kB"
    const double peak_mb = std::stod(peak.substr(peak.find_first_of("0123456789"))) / 1024;
    RecordProperty("peak_mb" + more, std::to_string(peak_mb));
    // A million rows are 50 MB of text; the program with its libraries has 70 MB.
    if (!kSanitized) {
      EXPECT_LT(peak_mb, 100) << more;
    }
    const std::string listed = read_file(folder / "listed");
    return std::count(listed.begin(), listed.end(), '\n');
  };
  EXPECT_EQ(list(""), kRows);
  EXPECT_EQ(list("--shard 7/1000"), kRows / 1000);
}

}  // namespace
}  // namespace walktrack
