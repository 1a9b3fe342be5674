// The self-test's own machinery, and its quickest trials.
#include "jobs/selftest/selftest.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/errors.h"
#include "tests/run_program.h"

namespace walktrack {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

TEST(Trial, EndsAsItsExtremeDeserves) {
  const TemporaryFolder folder;
  const auto end = [&](const char* name) { return run_trial(name, folder / name).end; };
  EXPECT_EQ(end("log-likelihoods 1e6 nats apart"), TrialEnd::kTracked);
  EXPECT_EQ(end("all log-weights -infinity"), TrialEnd::kReported);
  EXPECT_EQ(end("gravity upwards"), TrialEnd::kReported);
  EXPECT_EQ(end("a single frame"), TrialEnd::kDegraded);  // nobody walks in it
  EXPECT_THROW(run_trial("gravity upward", folder / "x"), UsageError);
}

TEST(Trial, MeasuresItselfAgainstTheTruth) {
  const TemporaryFolder folder;
  const TrialResult walk = run_trial("ordinary walk", folder / "walk");
  EXPECT_EQ(walk.end, TrialEnd::kTracked) << walk.what;
  EXPECT_THAT(walk.what, HasSubstr("60 of 60 frames; pelvis 0."));
  EXPECT_GT(walk.peak_memory, 1);
}

TEST(TrialLine, ComesBackAsItWas) {
  const TrialResult result{
      .name = "n", .end = TrialEnd::kDegraded, .what = "a\tb\nc", .peak_memory = 12};
  const TrialResult again = trial_from_line("n", trial_line(result));
  EXPECT_EQ(again.end, TrialEnd::kDegraded);
  EXPECT_EQ(again.what, "a b c");
  EXPECT_EQ(again.peak_memory, 12);
  EXPECT_EQ(trial_from_line("n", "terminate called").end, TrialEnd::kFailed);
  EXPECT_EQ(trial_from_line("n", "terminate called").what, "terminate called");
}

TEST(Selftest, ToldToStopItLeavesNothing) {
  const TemporaryFolder folder;
  SelftestJob job;
  const std::string script = folder.write(
      "trial.sh", "#!/bin/sh\nmkdir -p \"$3\" && touch \"$3/video\" && exec sleep 60\n");
  fs::permissions(script, fs::perms::owner_all);
  job.command = {script};
  job.folder = folder.path() / "work";
  std::atomic<bool> stop = false;
  JobControl control{.stop_request = &stop};
  control.report = [&](const Progress&) {
    if (fs::exists(job.folder / "00/video")) stop = true;
  };
  EXPECT_THAT(run_selftest(job, control), IsEmpty());
  EXPECT_TRUE(fs::is_empty(job.folder));
}

TEST(Selftest, BeginsWithTheTrialsOfMinutesAndPrintsThemInTheirPlace) {
  const TemporaryFolder folder;
  SelftestJob job;
  const std::string script = folder.write(
      "trial.sh",
      "#!/bin/sh\necho \"$1\" >> \"${3%/*}/../begun\"\nprintf 'tracked\\t5\\tfine\\n'\n");
  fs::permissions(script, fs::perms::owner_all);
  job.command = {script};
  job.folder = folder.path() / "work";
  job.stress = true;
  const auto results = run_selftest(job, {});
  std::vector<std::string> names;
  for (const TrialResult& result : results) names.push_back(result.name);
  EXPECT_EQ(names, trial_names(true));
  EXPECT_THAT(read_file(folder.path() / "begun"),
              StartsWith("1,000,000 particles\n8K images, person 4,000 px high\n10,000 frames\n"
                         "ordinary walk\n"));
}

TEST(Selftest, TellsOfCrashesAndOfProcessesThatSayNothing) {
  const TemporaryFolder folder;
  SelftestJob job;
  const std::string script = folder.write("trial.sh",
                                          "#!/bin/sh\n"
                                          "case $1 in\n"
                                          "  '1 particle') kill -SEGV $$;;\n"
                                          "  'a single frame') ;;\n"
                                          "  *) printf 'tracked\\t5\\tfine\\n';;\n"
                                          "esac\n");
  fs::permissions(script, fs::perms::owner_all);
  job.command = {script};
  job.folder = folder.path() / "work";
  job.jobs = 3;
  const auto results = run_selftest(job, {});
  const auto names = trial_names(false);
  ASSERT_EQ(results.size(), names.size());
  EXPECT_LT(names.size(), trial_names(true).size());
  for (size_t i = 0; i < names.size(); ++i) {
    EXPECT_EQ(results[i].name, names[i]);
    const bool bad = names[i] == "1 particle" || names[i] == "a single frame";
    EXPECT_EQ(results[i].end, bad ? TrialEnd::kFailed : TrialEnd::kTracked) << names[i];
    if (names[i] == "1 particle") {
      EXPECT_THAT(results[i].what, HasSubstr("signal 11"));
    }
  }
  EXPECT_TRUE(fs::is_empty(job.folder));
  EXPECT_THAT(selftest_table(results), HasSubstr("0 reported, 2 failed\n"));
}

}  // namespace
}  // namespace walktrack
