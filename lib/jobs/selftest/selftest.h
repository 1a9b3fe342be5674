// `walktrack selftest`: extreme recordings and configurations, each tried on the installed program
// with videos that are rendered for it. Every trial has to end as
//   tracked    the walker was followed, within kTrackedWithin of the truth if there is one
//   degraded   there is a result with a statement of what is wrong with it (exit 4 of `track`), or
//              the errors are stated here
//   reported   the input was refused with a message for the user
// Anything else is a failure: a number that is not finite, a crash, a hang, memory without bound.
// Each trial is a process of its own, so that crashes and hangs appear in the table as well.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/job_control.h"
#include "jobs/selftest/selftest_trials.h"

namespace walktrack {
inline namespace jobs {

std::string_view trial_end_name(TrialEnd end);

// The line that a trial's process prints last, and its parser, which returns kFailed for other
// lines.
std::string trial_line(const TrialResult& result);
TrialResult trial_from_line(const std::string& name, const std::string& line);

struct SelftestJob {
  // A program and options that run one trial and print its line; "NAME -o FOLDER" is appended.
  std::vector<std::string> command;
  std::filesystem::path folder;  // empty, for videos and results; files of trials are removed
  bool stress = false;
  int jobs = 1;  // trials at a time
};

// All trials, in the order of the table; fewer if it was interrupted.
std::vector<TrialResult> run_selftest(const SelftestJob& job, const JobControl& control);

// The table for a terminal; its last line counts the outcomes of the trials.
std::string selftest_table(const std::vector<TrialResult>& results);

}  // namespace jobs
}  // namespace walktrack
