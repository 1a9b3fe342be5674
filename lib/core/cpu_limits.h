// The number of threads that can run at once: the CPUs that this process may use (its affinity
// mask, with which Slurm, taskset and cpusets allot them) and the CPU time that its control groups
// grant (containers, systemd), https://docs.kernel.org/admin-guide/cgroup-v2.html#cpu and
// https://docs.kernel.org/scheduler/sched-bwc.html.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

namespace walktrack {
inline namespace core {

// CPUs in the affinity mask of the calling thread; 0 if the system does not state it.
int allowed_cpus();

// The limit of a group in CPUs, from the content of its files; nullopt: no limit, or no such text.
// Version 2, cpu.max: "max 100000", "150000 100000". Version 1: cpu.cfs_quota_us, where -1 means no
// limit, and cpu.cfs_period_us.
std::optional<double> limit_from_cpu_max(std::string_view cpu_max);
std::optional<double> limit_from_quota(std::string_view quota_us, std::string_view period_us);

// The folders below /sys/fs/cgroup with limits of CPU time for a process with this
// /proc/self/cgroup: those of its own group and of all groups above it.
std::vector<std::filesystem::path> cpu_groups(std::string_view proc_self_cgroup);

// The smallest limit of this process; nullopt: none. `root`: of the file system.
std::optional<double> cpu_time_limit(const std::filesystem::path& root = "/");

// The number of threads for so many CPUs and such a limit, at least 1, rounded up.
int threads_for(int cpus, std::optional<double> limit);

}  // namespace core
}  // namespace walktrack
