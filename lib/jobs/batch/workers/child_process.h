// Runs another program as a child process, without a shell and with limits.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace walktrack {
inline namespace jobs {

struct ChildLimits {
  double seconds = 0;    // of wall time; 0 = none
  size_t memory_mb = 0;  // of address space; 0 = none
};

struct ChildEnd {
  int exit_code = 0;  // of the program; 128 + signal if one ended it
  int signal = 0;     // 0 = it was not ended by a signal
  bool timed_out = false;
  double seconds = 0;
};

class ChildProcess {
 public:
  // Starts words[0] with the other words as arguments. Its output goes to the new file `log`, its
  // input is empty. Throws std::runtime_error if the file exists or no process can be created; a
  // program that cannot be started ends with exit code 127.
  ChildProcess(const std::vector<std::string>& words, const std::filesystem::path& log,
               const ChildLimits& limits);
  // Kills the child if it still runs.
  ~ChildProcess();
  ChildProcess(ChildProcess&& other) noexcept;
  ChildProcess& operator=(ChildProcess&&) = delete;

  // How it ended; nullopt while it runs. A child that exceeds its time limit is killed.
  std::optional<ChildEnd> poll();
  // Asks it to stop (SIGTERM).
  void ask_to_stop() const;

 private:
  using Clock = std::chrono::steady_clock;
  int pid_ = -1;  // -1 = ended
  ChildLimits limits_;
  Clock::time_point start_;
  bool timed_out_ = false;
};

}  // namespace jobs
}  // namespace walktrack
