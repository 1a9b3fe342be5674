// The terminal's part of a running job: signals that interrupt it, a progress bar, messages.
#pragma once

#include <atomic>
#include <string>
#include <string_view>

#include "command.h"
#include "core/job_control.h"
#include "progress_pace.h"

namespace walktrack {

// From now on SIGINT and SIGTERM set the stop request; a second signal ends the program at once.
void watch_signals();

// Set by a signal; jobs test it between frames.
const std::atomic<bool>& stop_request();

// Shows a job on stderr: messages unless --quiet, and its progress. On a terminal that is one line
// that is redrawn, "tracking [=====>    ] 41/84  12.3/s  3 s left" (plain with NO_COLOR); otherwise
// a line every half minute, so that a log shows that a long run continues. With --progress json
// everything is a line of JSON (progress_pace.h).
class Terminal {
 public:
  explicit Terminal(const CommonOptions& options);
  ~Terminal();
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  // The control for the job. It must not outlive this terminal.
  JobControl control();

 private:
  enum class Style { kNone, kBar, kLog, kJson };
  static Style style_of(const CommonOptions& options);
  void say(std::string_view text);
  void show(const Progress& progress);
  std::string bar(const Progress& progress) const;
  void finish_line();  // so that a message can follow

  bool quiet_, colour_;
  Style style_;
  ProgressPace pace_;
  bool line_open_ = false;
};

}  // namespace walktrack
