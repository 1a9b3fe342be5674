#include "jobs/batch/workers/shard.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>

#include <fmt/format.h>

#include "core/errors.h"

namespace walktrack {
inline namespace jobs {

namespace {

[[noreturn]] void fail(const std::string& found, const std::string& allowed) {
  throw UsageError(describe({"", 0, "--shard"}, found, allowed));
}

std::optional<int> whole(const std::string& text) {
  int value = 0;
  const char* end = text.data() + text.size();
  const auto [rest, trouble] = std::from_chars(text.data(), end, value);
  return trouble == std::errc() && rest == end ? std::optional(value) : std::nullopt;
}

std::optional<int> number(const Environment& environment, const char* name) {
  const auto text = environment(name);
  if (!text) return std::nullopt;
  const auto value = whole(*text);
  if (!value) fail(fmt::format("{}={}", name, *text), "a whole number");
  return value;
}

// A variable that is required because another one is set.
int needed(const Environment& environment, const char* name, const char* beside) {
  const auto value = number(environment, name);
  if (!value) fail(fmt::format("{} without {}", beside, name), "both, or i/n");
  return *value;
}

Shard checked(Shard shard, const std::string& found) {
  if (shard.index < 1 || shard.index > shard.count) fail(found, "i/n, i from 1 to n");
  return shard;
}

// The tasks of an array and the tasks in each; either may be missing.
std::optional<Shard> of_slurm(const Environment& environment) {
  const auto id = number(environment, "SLURM_ARRAY_TASK_ID");
  const auto task = number(environment, "SLURM_PROCID");
  if (!id && !task) return std::nullopt;
  Shard array;
  if (id) {
    const int least = needed(environment, "SLURM_ARRAY_TASK_MIN", "SLURM_ARRAY_TASK_ID");
    const int step = number(environment, "SLURM_ARRAY_TASK_STEP").value_or(1);
    array.count = needed(environment, "SLURM_ARRAY_TASK_COUNT", "SLURM_ARRAY_TASK_ID");
    array.index = (*id - least) / std::max(1, step) + 1;
  }
  const int tasks = task ? number(environment, "SLURM_STEP_NUM_TASKS").value_or(1) : 1;
  return Shard{(array.index - 1) * tasks + task.value_or(0) + 1, array.count * tasks};
}

std::optional<Shard> of_aws(const Environment& environment) {
  const auto index = number(environment, "AWS_BATCH_JOB_ARRAY_INDEX");
  if (!index) return std::nullopt;
  return Shard{*index + 1,
               needed(environment, "AWS_BATCH_JOB_ARRAY_SIZE", "AWS_BATCH_JOB_ARRAY_INDEX")};
}

Shard of_kubernetes(const Environment& environment, int count) {
  const auto index = number(environment, "JOB_COMPLETION_INDEX");
  if (!index) fail("auto/n without JOB_COMPLETION_INDEX", "a Kubernetes Indexed Job, or i/n");
  return {*index + 1, count};
}

Shard of_scheduler(const Environment& environment) {
  if (const auto shard = of_slurm(environment)) return checked(*shard, "Slurm's variables");
  if (const auto shard = of_aws(environment)) return checked(*shard, "AWS Batch's variables");
  if (environment("JOB_COMPLETION_INDEX"))
    fail("auto, and Kubernetes does not say how many workers there are", "auto/n");
  fail("auto, and no variables of Slurm or AWS Batch", "i/n, i from 1 to n");
}

}  // namespace

Environment process_environment() {
  return [](const char* name) -> std::optional<std::string> {
    const char* value = std::getenv(name);
    return value ? std::optional<std::string>(value) : std::nullopt;
  };
}

Shard shard_from(const std::string& text, const Environment& environment) {
  if (text == "auto") return of_scheduler(environment);
  const std::string found = fmt::format("'{}'", text), allowed = "i/n, i from 1 to n";
  const size_t slash = text.find('/');
  if (slash == std::string::npos) fail(found, allowed);
  const auto count = whole(text.substr(slash + 1));
  if (!count) fail(found, allowed);
  if (text.substr(0, slash) == "auto") return checked(of_kubernetes(environment, *count), found);
  const auto index = whole(text.substr(0, slash));
  if (!index) fail(found, allowed);
  return checked({*index, *count}, found);
}

}  // namespace jobs
}  // namespace walktrack
