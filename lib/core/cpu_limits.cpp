#include "core/cpu_limits.h"

#include <sched.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <string>

namespace walktrack {
inline namespace core {

namespace fs = std::filesystem;

namespace {

std::string_view next_word(std::string_view& text) {
  constexpr std::string_view kBlanks = " \t\n";
  text.remove_prefix(std::min(text.find_first_not_of(kBlanks), text.size()));
  const std::string_view word = text.substr(0, text.find_first_of(kBlanks));
  text.remove_prefix(word.size());
  return word;
}

std::optional<double> positive(std::string_view word) {
  long long number = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (error != std::errc() || end != word.data() + word.size() || number <= 0) return std::nullopt;
  return static_cast<double>(number);
}

// Cuts off and returns the text before the first `at`, which is removed as well.
std::string_view cut(std::string_view& text, char at) {
  const std::string_view before = text.substr(0, text.find(at));
  text.remove_prefix(std::min(before.size() + 1, text.size()));
  return before;
}

bool limits_cpu(std::string_view controllers) {
  while (!controllers.empty())
    if (cut(controllers, ',') == "cpu") return true;
  return false;
}

void add_with_parents(const fs::path& hierarchy, const fs::path& group,
                      std::vector<fs::path>& out) {
  for (fs::path each = group.relative_path(); !each.empty(); each = each.parent_path())
    out.push_back(hierarchy / each);
  out.push_back(hierarchy);
}

// The content of the file; empty if there is no such file.
std::string text_of(const fs::path& path) {
  std::ifstream stream(path);
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace

int allowed_cpus() {
  constexpr size_t kMostCpus = size_t{1} << 14;
  cpu_set_t* const set = CPU_ALLOC(kMostCpus);
  if (set == nullptr) return 0;
  const size_t bytes = CPU_ALLOC_SIZE(kMostCpus);
  CPU_ZERO_S(bytes, set);
  const int count = sched_getaffinity(0, bytes, set) == 0 ? CPU_COUNT_S(bytes, set) : 0;
  CPU_FREE(set);
  return count;
}

std::optional<double> limit_from_quota(std::string_view quota_us, std::string_view period_us) {
  const auto quota = positive(next_word(quota_us)), period = positive(next_word(period_us));
  if (!quota || !period) return std::nullopt;
  return *quota / *period;
}

std::optional<double> limit_from_cpu_max(std::string_view cpu_max) {
  const std::string_view quota = next_word(cpu_max);
  return limit_from_quota(quota, cpu_max);
}

std::vector<fs::path> cpu_groups(std::string_view proc_self_cgroup) {
  const fs::path mounted = "/sys/fs/cgroup";
  std::vector<fs::path> out;
  while (!proc_self_cgroup.empty()) {
    std::string_view line = cut(proc_self_cgroup, '\n');
    const bool second_version = cut(line, ':') == "0";
    const std::string_view controllers = cut(line, ':');
    if (second_version && controllers.empty()) {
      add_with_parents(mounted, line, out);
      add_with_parents(mounted / "unified", line, out);  // present beside groups of version 1
    } else if (limits_cpu(controllers)) {
      add_with_parents(mounted / controllers, line, out);
    }
  }
  return out;
}

std::optional<double> cpu_time_limit(const fs::path& root) {
  std::optional<double> least;
  for (const fs::path& group : cpu_groups(text_of(root / "proc/self/cgroup"))) {
    const fs::path folder = root / group.relative_path();
    for (const auto limit : {limit_from_cpu_max(text_of(folder / "cpu.max")),
                             limit_from_quota(text_of(folder / "cpu.cfs_quota_us"),
                                              text_of(folder / "cpu.cfs_period_us"))})
      if (limit) least = std::min(*limit, least.value_or(*limit));
  }
  return least;
}

int threads_for(int cpus, std::optional<double> limit) {
  constexpr double kMost = 1 << 20;
  if (limit) cpus = std::min(cpus, static_cast<int>(std::ceil(std::min(*limit, kMost))));
  return std::max(1, cpus);
}

}  // namespace core
}  // namespace walktrack
