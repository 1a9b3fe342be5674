// How many threads can run at once: the CPUs that this process may use (its affinity mask, which is
// how Slurm, taskset and cpusets allot them) and the CPU time that its control groups grant it
// (containers, systemd), https://docs.kernel.org/admin-guide/cgroup-v2.html#cpu and
// https://docs.kernel.org/scheduler/sched-bwc.html.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

namespace walktrack {
inline namespace core {

// CPUs of the affinity mask of the calling thread; 0 where the system does not tell.
int allowed_cpus();

// CPUs' worth of time that a group may take, by the text of its files; nullopt: no limit, or no
// such text. Version 2, cpu.max: "max 100000", "150000 100000". Version 1: cpu.cfs_quota_us, -1
// without limit, and cpu.cfs_period_us.
std::optional<double> limit_from_cpu_max(std::string_view cpu_max);
std::optional<double> limit_from_quota(std::string_view quota_us, std::string_view period_us);

// The folders below /sys/fs/cgroup whose limits hold for a process with this /proc/self/cgroup,
// its own and all above it, as far as they limit CPU time.
std::vector<std::filesystem::path> cpu_groups(std::string_view proc_self_cgroup);

// The tightest of the limits of this process; nullopt: none. `root`: of the file system.
std::optional<double> cpu_time_limit(const std::filesystem::path& root = "/");

// Threads for so many CPUs and such a limit, at least 1; a part of a CPU counts as one.
int threads_for(int cpus, std::optional<double> limit);

}  // namespace core
}  // namespace walktrack
