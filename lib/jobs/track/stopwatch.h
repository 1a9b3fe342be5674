// Measures the time of stages: wall time, and the CPU time of all threads.
#pragma once

#include <chrono>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace walktrack {
inline namespace jobs {

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start);

// CPU seconds of this process and of this thread so far.
double process_cpu_seconds();
double thread_cpu_seconds();

struct Elapsed {
  double seconds = 0, cpu = 0;
};

// A point in time, with the CPU time of all threads so far.
struct TimePoint {
  Clock::time_point clock = Clock::now();
  double cpu = process_cpu_seconds();
};
Elapsed elapsed_since(const TimePoint& moment);

// Seconds by stage, in the order of first use.
class Stopwatch {
 public:
  using Stages = std::vector<std::pair<std::string, double>>;
  void add(std::string_view stage, const Elapsed& spent);
  const Stages& stages() const { return stages_; }
  const Stages& cpu_stages() const { return cpu_stages_; }

 private:
  Stages stages_, cpu_stages_;
};

}  // namespace jobs
}  // namespace walktrack
