#include "core/cpu_limits.h"

#include <sched.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>

#include <gtest/gtest.h>

#include "core/parallel_for.h"
#include "tests/run_program.h"

namespace walktrack {
namespace {

namespace fs = std::filesystem;

TEST(CpuLimits, OfAGroupAreReadFromItsFiles) {
  EXPECT_EQ(limit_from_cpu_max("200000 100000\n"), 2);
  EXPECT_EQ(limit_from_cpu_max("50000 100000\n"), 0.5);
  EXPECT_EQ(limit_from_quota("150000\n", "100000\n"), 1.5);
  for (const char* none : {"max 100000\n", "", "\n", "max", "100000", "-1 100000", "0 100000",
                           "100000 0", "1e5 100000", "99999999999999999999 1", "a b"})
    EXPECT_EQ(limit_from_cpu_max(none), std::nullopt) << none;
  EXPECT_EQ(limit_from_quota("-1\n", "100000\n"), std::nullopt);
  EXPECT_EQ(limit_from_quota("", ""), std::nullopt);
}

TEST(CpuLimits, ThreadsAreAtMostTheCpusAndAtLeastOne) {
  EXPECT_EQ(threads_for(8, std::nullopt), 8);
  EXPECT_EQ(threads_for(8, 2.0), 2);
  EXPECT_EQ(threads_for(8, 1.5), 2);
  EXPECT_EQ(threads_for(8, 0.1), 1);
  EXPECT_EQ(threads_for(2, 64.0), 2);
  EXPECT_EQ(threads_for(2, 1e300), 2);
  EXPECT_EQ(threads_for(0, std::nullopt), 1);
}

TEST(CpuLimits, GroupsAreThoseOfTheProcessAndAllAboveThem) {
  const auto second = cpu_groups("0::/a.slice/b.scope\n");
  for (const char* folder :
       {"/sys/fs/cgroup/a.slice/b.scope", "/sys/fs/cgroup/a.slice", "/sys/fs/cgroup"})
    EXPECT_NE(std::ranges::find(second, fs::path(folder)), second.end()) << folder;
  const auto first = cpu_groups("5:memory:/m\n4:cpu,cpuacct:/job/step\n3:cpuset:/c\n");
  EXPECT_EQ(first, (std::vector<fs::path>{"/sys/fs/cgroup/cpu,cpuacct/job/step",
                                          "/sys/fs/cgroup/cpu,cpuacct/job",
                                          "/sys/fs/cgroup/cpu,cpuacct"}));
  for (const char* odd : {"", "\n", "0", "0::", ":::::", "4:cpu", "no group at all"})
    EXPECT_NO_THROW(cpu_groups(odd)) << odd;
}

// A file system as a process in a container sees it.
class Groups : public testing::Test {
 protected:
  std::optional<double> limit() const { return cpu_time_limit(root_.path()); }
  const TemporaryFolder root_;
};

TEST_F(Groups, TheTightestLimitOnTheWayUpHolds) {
  EXPECT_EQ(limit(), std::nullopt);
  root_.write("proc/self/cgroup", "0::/a/b\n");
  EXPECT_EQ(limit(), std::nullopt);
  root_.write("sys/fs/cgroup/a/b/cpu.max", "max 100000\n");
  EXPECT_EQ(limit(), std::nullopt);
  root_.write("sys/fs/cgroup/a/cpu.max", "300000 100000\n");
  EXPECT_EQ(limit(), 3);
  root_.write("sys/fs/cgroup/cpu.max", "400000 100000\n");
  EXPECT_EQ(limit(), 3);
}

// The path is the host's, although the container sees only its own group.
TEST_F(Groups, OfVersionOneInAContainer) {
  root_.write("proc/self/cgroup", "4:cpu,cpuacct:/docker/0123\n0::/\n");
  root_.write("sys/fs/cgroup/cpu,cpuacct/cpu.cfs_quota_us", "-1\n");
  root_.write("sys/fs/cgroup/cpu,cpuacct/cpu.cfs_period_us", "100000\n");
  EXPECT_EQ(limit(), std::nullopt);
  root_.write("sys/fs/cgroup/cpu,cpuacct/cpu.cfs_quota_us", "250000\n");
  EXPECT_EQ(limit(), 2.5);
}

// As with `taskset -c 0` or a Slurm job with one CPU: a process that may use one of many.
TEST(HardwareThreads, AreThoseThatTheProcessMayUse) {
  const pid_t child = fork();
  if (child == 0) {
    cpu_set_t set, one;
    CPU_ZERO(&one);
    sched_getaffinity(0, sizeof set, &set);
    for (int cpu = 0; cpu < CPU_SETSIZE && CPU_COUNT(&one) == 0; ++cpu)
      if (CPU_ISSET(cpu, &set)) CPU_SET(cpu, &one);
    sched_setaffinity(0, sizeof one, &one);
    _exit(10 * thread_count(0) + thread_count(3));
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_EQ(WEXITSTATUS(status), 13) << "one by default, three where they are asked for";
}

}  // namespace
}  // namespace walktrack
