#include "jobs/track/stopwatch.h"

#include <ctime>

namespace walktrack {
inline namespace jobs {

namespace {

double cpu_seconds(clockid_t clock) {
  constexpr double kSecondsPerNs = 1e-9;
  timespec time{};
  clock_gettime(clock, &time);
  return static_cast<double>(time.tv_sec) + kSecondsPerNs * static_cast<double>(time.tv_nsec);
}

void grow(Stopwatch::Stages& stages, std::string_view stage, double seconds) {
  for (auto& [name, sum] : stages) {
    if (name != stage) continue;
    sum += seconds;
    return;
  }
  stages.emplace_back(stage, seconds);
}

}  // namespace

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

double process_cpu_seconds() { return cpu_seconds(CLOCK_PROCESS_CPUTIME_ID); }
double thread_cpu_seconds() { return cpu_seconds(CLOCK_THREAD_CPUTIME_ID); }

Elapsed elapsed_since(const TimePoint& moment) {
  return {seconds_since(moment.clock), process_cpu_seconds() - moment.cpu};
}

void Stopwatch::add(std::string_view stage, const Elapsed& spent) {
  grow(stages_, stage, spent.seconds);
  grow(cpu_stages_, stage, spent.cpu);
}

}  // namespace jobs
}  // namespace walktrack
