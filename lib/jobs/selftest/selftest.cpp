#include "jobs/selftest/selftest.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cstring>
#include <list>
#include <numeric>
#include <thread>

#include <fmt/format.h>

#include "io/archive/files.h"
#include "io/config/text.h"
#include "jobs/batch/workers/child_process.h"

namespace walktrack {
inline namespace jobs {

namespace fs = std::filesystem;

namespace {

constexpr auto kTrialPollInterval = std::chrono::milliseconds(10);
constexpr size_t kMaxLogBytes = 16u << 20;
// Limits of one trial: many times what a correct one needs, so that a busy machine is not taken for
// a hang.
constexpr ChildLimits kLimits{.seconds = 300, .memory_mb = 4096};
constexpr ChildLimits kStressLimits{.seconds = 3600, .memory_mb = 12'288};

// Indices of the names, with trials of minutes first, so that none of them is left alone at the
// end.
std::vector<size_t> order_of(const std::vector<std::string>& names) {
  const std::vector<std::string> quick = trial_names(false);
  std::vector<size_t> order(names.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::stable_partition(order.begin(), order.end(), [&](size_t i) {
    return std::ranges::find(quick, names[i]) == quick.end();
  });
  return order;
}

struct RunningTrial {
  size_t index;
  ChildProcess child;
};

std::string last_line(const fs::path& log) {
  std::string text = read_text_file(log, kMaxLogBytes);
  while (text.ends_with('\n')) text.pop_back();
  return text.substr(text.rfind('\n') + 1);
}

TrialResult result_of(const std::string& name, const ChildEnd& end, const fs::path& log) {
  TrialResult result = trial_from_line(name, last_line(log));
  result.seconds = end.seconds;
  if (end.timed_out) {
    result.what = fmt::format("hangs: took longer than {:.0f} s", end.seconds);
  } else if (end.signal != 0) {
    result.what = fmt::format("ended by signal {} ({})", end.signal, strsignal(end.signal));
  }
  if (end.timed_out || end.signal != 0 || end.exit_code != 0) result.end = TrialEnd::kFailed;
  return result;
}

}  // namespace

std::string_view trial_end_name(TrialEnd end) {
  constexpr std::array<std::string_view, 4> kNames{"tracked", "degraded", "reported", "FAILED"};
  return kNames[static_cast<size_t>(end)];
}

std::string trial_line(const TrialResult& result) {
  return fmt::format("{}\t{:.0f}\t{}", trial_end_name(result.end), result.peak_memory,
                     one_line(result.what));
}

TrialResult trial_from_line(const std::string& name, const std::string& line) {
  TrialResult result{.name = name, .what = line};
  const size_t first = line.find('\t');
  const size_t second = line.find('\t', first + 1);
  if (first == std::string::npos || second == std::string::npos) return result;
  for (const TrialEnd end : {TrialEnd::kTracked, TrialEnd::kDegraded, TrialEnd::kReported}) {
    if (line.substr(0, first) == trial_end_name(end)) result.end = end;
  }
  result.peak_memory =
      number_from_text(std::string_view(line).substr(first + 1, second - first - 1)).value_or(0);
  result.what = line.substr(second + 1);
  return result;
}

std::vector<TrialResult> run_selftest(const SelftestJob& job, const JobControl& control) {
  const std::vector<std::string> names = trial_names(job.stress);
  const std::vector<size_t> order = order_of(names);
  std::vector<TrialResult> results(names.size());
  std::vector<bool> done(names.size(), false);
  std::list<RunningTrial> running;
  const auto place = [&](size_t i) { return job.folder / fmt::format("{:02}", i); };
  const auto log = [&](size_t i) { return job.folder / fmt::format("{:02}.log", i); };
  fs::create_directories(job.folder);
  size_t next = 0;
  while ((next < names.size() || !running.empty()) && !control.stopping()) {
    if (next < names.size() && static_cast<int>(running.size()) < job.jobs) {
      const size_t index = order[next++];
      std::vector<std::string> words = job.command;
      words.insert(words.end(), {names[index], "-o", place(index).string()});
      running.push_back(
          {index, ChildProcess(words, log(index), job.stress ? kStressLimits : kLimits)});
      continue;
    }
    std::this_thread::sleep_for(kTrialPollInterval);
    std::erase_if(running, [&](RunningTrial& each) {
      const auto end = each.child.poll();
      if (!end) return false;
      results[each.index] = result_of(names[each.index], *end, log(each.index));
      done[each.index] = true;
      fs::remove_all(place(each.index));
      fs::remove(log(each.index));
      return true;
    });
    control.progress("trials", next - running.size(), names.size());
  }
  while (!running.empty()) {  // interrupted: ends the trials and removes their files
    const size_t index = running.front().index;
    running.pop_front();
    fs::remove_all(place(index));
    fs::remove(log(index));
  }
  std::vector<TrialResult> finished;
  for (size_t i = 0; i < names.size(); ++i) {
    if (done[i]) finished.push_back(std::move(results[i]));
  }
  return finished;
}

std::string selftest_table(const std::vector<TrialResult>& results) {
  std::string table = fmt::format("{:<32} {:<9} {:>6} {:>6}  {}\n", "trial", "ends", "s", "MB", "");
  std::array<int, 4> counts{};
  for (const TrialResult& result : results) {
    table +=
        fmt::format("{:<32} {:<9} {:>6.1f} {:>6.0f}  {}\n", result.name, trial_end_name(result.end),
                    result.seconds, result.peak_memory, one_line(result.what));
    ++counts[static_cast<size_t>(result.end)];
  }
  return table + fmt::format("{} trials: {} tracked, {} degraded, {} reported, {} failed\n",
                             results.size(), counts[0], counts[1], counts[2], counts[3]);
}

}  // namespace jobs
}  // namespace walktrack
