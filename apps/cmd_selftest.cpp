// walktrack selftest: extreme inputs for the installed program.
#include <filesystem>

#include <fmt/format.h>

#include "commands.h"
#include "core/parallel_for.h"
#include "io/archive/files.h"
#include "jobs/selftest/selftest.h"
#include "terminal.h"

namespace walktrack {

namespace po = boost::program_options;
namespace fs = std::filesystem;

int run_selftest(const Arguments& arguments) {
  bool stress = false;
  std::string trial;
  CommandLine line(
      {.name = "selftest",
       .operands = "",
       .about =
           "Tries extreme walks, pictures, bodies and settings with this program and prints the "
           "outcome of\neach: tracked, degraded (with the reason) or reported (refused with a "
           "reason).\nEvery other outcome is a failure, with exit code 1. It takes one to two "
           "minutes, with --stress\nsome minutes more and 8 GB of memory. It works in a temporary "
           "folder, inside of the folder --output if\nthat is given, and removes it at the end.",
       .example = "walktrack selftest"});
  line.options().add_options()("stress", po::bool_switch(&stress),
                               "add the trials that take minutes")(
      "trial", po::value(&trial)->value_name("NAME"),
      "run only this trial, in the new folder --output");
  if (!line.parse(arguments)) return kDone;
  if (!trial.empty()) {
    fmt::print("{}\n", trial_line(run_trial(trial, line.required_output())));
    return kDone;
  }
  SelftestJob job;
  job.command = {fs::read_symlink("/proc/self/exe").string(), "selftest", "--trial"};
  const fs::path place = line.common().output;
  if (!place.empty()) fs::create_directories(place);
  job.folder =
      new_folder((place.empty() ? fs::temp_directory_path() : place) / "walktrack_selftest_");
  job.stress = stress;
  job.jobs = hardware_threads();
  Terminal terminal(line.common());
  const std::vector<TrialResult> results = run_selftest(job, terminal.control());
  fmt::print("{}", selftest_table(results));
  std::error_code ignored;
  fs::remove_all(job.folder, ignored);
  for (const TrialResult& result : results) {
    if (result.end == TrialEnd::kFailed) return kFailed;
  }
  return kDone;
}

}  // namespace walktrack
