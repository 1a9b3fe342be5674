// walktrack track: tracks a scene and writes a result folder.
#include <optional>

#include <fmt/format.h>

#include "commands.h"
#include "core/errors.h"
#include "io/archive/files.h"
#include "io/scene/scene.h"
#include "jobs/track/track.h"
#include "terminal.h"

namespace walktrack {

namespace po = boost::program_options;

namespace {

int exit_code(TrackStatus status) {
  switch (status) {
    case TrackStatus::kTracked:
      return kDone;
    case TrackStatus::kNotFound:
    case TrackStatus::kQualityFailed:
      return kDegraded;
    case TrackStatus::kInterrupted:
      return kInterrupted;
    case TrackStatus::kCutShort:
      break;  // an error of the input
  }
  return kUnreadable;
}

double above_zero(const char* option, const std::string& text) {
  const std::optional<double> value = number_from_text(text);
  if (!value || *value <= 0) throw UsageError(describe({"", 0, option}, text, "a number above 0"));
  return *value;
}

// Both options set budget.frame_ms.
void set_budget(const std::string& fps, const std::string& budget_ms, ConfigWithOrigin& config) {
  constexpr double kMsPerSecond = 1000;
  if (!fps.empty() && !budget_ms.empty())
    throw UsageError("--fps and --budget-ms exclude each other");
  if (fps.empty() && budget_ms.empty()) return;
  const bool rate = !fps.empty();
  const double ms =
      rate ? kMsPerSecond / above_zero("--fps", fps) : above_zero("--budget-ms", budget_ms);
  apply_setting(config, "budget.frame_ms=" + shortest_number(ms), rate ? "--fps" : "--budget-ms");
}

// Prints the outcome and returns the exit code.
int report(const TrackOutcome& outcome, const JobControl& control) {
  const bool cut_short = outcome.status == TrackStatus::kCutShort;
  const bool listed = !outcome.failed_checks.empty();  // printed by the summary
  if (!outcome.message.empty() && !cut_short && !listed) control.say(outcome.message);
  if (outcome.resumable) control.say("interrupted; run again with --resume to continue from here");
  control.say(summary_text(outcome));
  // Reported last, and also with --quiet, although the result before it is kept.
  if (cut_short) throw InputError(outcome.message);
  return stop_request() ? kInterrupted : exit_code(outcome.status);
}

}  // namespace

int run_track(const Arguments& arguments) {
  std::string scene;
  bool no_overlay = false, resume = false, ignore_checks = false, json_line = false;
  std::string fps, budget_ms;
  CommandLine line(
      {.name = "track",
       .operands = "SCENE.yaml",
       .about = "Tracks the subject of one scene: 3-D joints and angles with their "
                "uncertainty,\nan overlay video for each camera, and run.json, in the folder "
                "--output.\nThe scene is checked first; an error in it stops the command with exit "
                "code 3.\nThe exit code is 4 if a quality check failed: the report and run.json "
                "say which one failed,\nwhat it means and what to do.",
       .example = "walktrack track data/demo/scene.yaml -o out/demo"});
  auto add = line.options().add_options();
  add("no-overlay", po::bool_switch(&no_overlay), "write no overlay videos");
  add("ignore-checks", po::bool_switch(&ignore_checks),
      "track even if checks of the scene fail (see walktrack check); the report says so");
  add("fps", po::value(&fps)->value_name("N"),
      "track this many frames/s by adapting the number of particles between budget.least_particles "
      "and budget.most_particles; results then depend on the speed of the machine and are not "
      "deterministic");
  add("budget-ms", po::value(&budget_ms)->value_name("N"),
      "the same as --fps, in milliseconds for each frame");
  add("resume", po::bool_switch(&resume),
      "continue from the last checkpoint of a run that was killed or interrupted, with the same "
      "result as without interruption; with -y a checkpoint that does not fit is ignored");
  add("json-line", po::bool_switch(&json_line),
      "print the result, or the error, as one line of JSON");
  line.operand("SCENE.yaml", &scene);
  if (!line.parse(arguments)) return kDone;
  TrackJob job;
  job.output = line.required_output();
  job.config = line.config();
  set_budget(fps, budget_ms, job.config);
  job.overlay = !no_overlay;
  job.resume = resume;
  job.ignore_checks = ignore_checks;
  job.overwrite = line.common().overwrite;
  job.command_line = {"walktrack", "track"};
  job.command_line.insert(job.command_line.end(), arguments.begin(), arguments.end());
  job.scene = read_scene(scene);
  Terminal terminal(line.common());
  const TrackOutcome outcome = track_scene(job, terminal.control());
  const int code = report(outcome, terminal.control());
  if (json_line) fmt::print("{}", summary_json(outcome, job.output.string(), code));
  return code;
}

}  // namespace walktrack
