#include "jobs/batch/workers/shard.h"

#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/errors.h"
#include "tests/message_of.h"

namespace walktrack {
namespace {

using testing::HasSubstr;
using Variables = std::map<std::string, std::string>;

Environment of(const Variables& variables) {
  return [variables](const char* name) -> std::optional<std::string> {
    const auto found = variables.find(name);
    return found == variables.end() ? std::nullopt : std::optional(found->second);
  };
}

void expect_shard(const std::string& text, const Variables& variables, int index, int count) {
  const Shard shard = shard_from(text, of(variables));
  EXPECT_EQ(shard.index, index) << text;
  EXPECT_EQ(shard.count, count) << text;
}

std::string trouble(const std::string& text, const Variables& variables) {
  return message_of<UsageError>([&] { shard_from(text, of(variables)); });
}

TEST(Shard, IsWhatIsWritten) {
  expect_shard("2/8", {{"SLURM_PROCID", "3"}}, 2, 8);
  for (const char* wrong : {"", "3", "3/2", "0/2", "a/b", "1/2x", "1/", "auto/x"})
    EXPECT_THAT(trouble(wrong, {}), HasSubstr("allowed: i/n")) << wrong;
}

// --array=10-16:2: tasks 10, 12, 14, 16.
TEST(Shard, OfASlurmArrayCountsFromItsFirstTask) {
  const Variables array{{"SLURM_ARRAY_TASK_ID", "14"},
                        {"SLURM_ARRAY_TASK_MIN", "10"},
                        {"SLURM_ARRAY_TASK_STEP", "2"},
                        {"SLURM_ARRAY_TASK_COUNT", "4"}};
  expect_shard("auto", array, 3, 4);
  Variables tasks = array;
  tasks["SLURM_PROCID"] = "1";
  tasks["SLURM_STEP_NUM_TASKS"] = "2";
  expect_shard("auto", tasks, 6, 8);
  expect_shard("auto", {{"SLURM_PROCID", "0"}, {"SLURM_STEP_NUM_TASKS", "5"}}, 1, 5);
}

// Every worker has a share of its own, and every share has a worker.
TEST(Shard, OfSlurmTasksAreAllDifferent) {
  std::map<int, int> seen;
  for (int id = 1; id <= 3; ++id)
    for (int task = 0; task < 4; ++task)
      ++seen[shard_from("auto", of({{"SLURM_ARRAY_TASK_ID", std::to_string(id)},
                                    {"SLURM_ARRAY_TASK_MIN", "1"},
                                    {"SLURM_ARRAY_TASK_COUNT", "3"},
                                    {"SLURM_PROCID", std::to_string(task)},
                                    {"SLURM_STEP_NUM_TASKS", "4"}}))
                 .index];
  EXPECT_EQ(seen.size(), 12u);
  EXPECT_EQ(seen.begin()->first, 1);
  EXPECT_EQ(seen.rbegin()->first, 12);
}

TEST(Shard, OfAwsAndKubernetesCountFromZero) {
  expect_shard("auto", {{"AWS_BATCH_JOB_ARRAY_INDEX", "0"}, {"AWS_BATCH_JOB_ARRAY_SIZE", "9"}}, 1,
               9);
  expect_shard("auto/5", {{"JOB_COMPLETION_INDEX", "4"}}, 5, 5);
}

TEST(Shard, SaysWhatIsMissing) {
  EXPECT_THAT(trouble("auto", {}),
              HasSubstr("--shard: found auto, and no variables of Slurm or AWS"));
  EXPECT_THAT(trouble("auto", {{"JOB_COMPLETION_INDEX", "1"}}), HasSubstr("allowed: auto/n"));
  EXPECT_THAT(trouble("auto/2", {{"JOB_COMPLETION_INDEX", "2"}}), HasSubstr("found 'auto/2'"));
  EXPECT_THAT(trouble("auto/2", {}), HasSubstr("auto/n without JOB_COMPLETION_INDEX"));
  EXPECT_THAT(trouble("auto", {{"SLURM_ARRAY_TASK_ID", "1"}}),
              HasSubstr("SLURM_ARRAY_TASK_ID without SLURM_ARRAY_TASK_MIN"));
  EXPECT_THAT(trouble("auto", {{"SLURM_PROCID", "one"}}), HasSubstr("found SLURM_PROCID=one"));
}

}  // namespace
}  // namespace walktrack
