// The terminal's side of a running job: signals that ask it to stop, a progress bar, messages.
#pragma once

#include <atomic>
#include <chrono>
#include <string>
#include <string_view>

#include "command.h"
#include "core/job_control.h"

namespace walktrack {

// From now on SIGINT and SIGTERM raise the stop request; a second one ends the program at once.
void watch_signals();

// Raised by a signal; jobs look at it between frames.
const std::atomic<bool>& stop_request();

// Shows a job on stderr: messages unless --quiet, and on a terminal one line of progress drawn over
// itself, "tracking [=====>    ] 41/84  12.3/s  3 s left" (plain with NO_COLOR).
class Terminal {
 public:
  explicit Terminal(const CommonOptions& options);
  ~Terminal();
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  // What the job is given. Must not outlive this terminal.
  JobControl control();

 private:
  using Clock = std::chrono::steady_clock;
  void say(std::string_view text);
  void draw(const Progress& progress);
  std::string line(const Progress& progress) const;
  void finish_line();  // so that a message can follow

  bool quiet_, interactive_, colour_;
  bool line_open_ = false;
  std::string what_;
  Clock::time_point start_, drawn_;
  size_t done_before_ = 0;  // at start_
};

}  // namespace walktrack
