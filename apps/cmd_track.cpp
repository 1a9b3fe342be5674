// walktrack track: one scene becomes a result folder.
#include <fmt/format.h>

#include "commands.h"
#include "io/scene.h"
#include "jobs/track.h"
#include "terminal.h"

namespace walktrack {

namespace {

int exit_code(TrackStatus status) {
  switch (status) {
    case TrackStatus::kTracked:
      return kDone;
    case TrackStatus::kNotFound:
    case TrackStatus::kBelowGates:
      return kDegraded;
    case TrackStatus::kInterrupted:
      return kInterrupted;
    case TrackStatus::kCutShort:
      return kUnreadable;
  }
  return kFailed;
}

}  // namespace

int run_track(const Arguments& arguments) {
  std::string scene;
  bool no_overlay = false, resume = false;
  CommandLine line({.name = "track",
                    .operands = "SCENE.yaml",
                    .about = "Tracks the walker of one scene: 3-D joints and angles with their "
                             "uncertainty,\nan overlay video for each camera, and run.json, in the "
                             "folder --output.",
                    .example = "walktrack track data/demo/scene.yaml -o out/demo"});
  namespace po = boost::program_options;
  line.options().add_options()("no-overlay", po::bool_switch(&no_overlay),
                               "write no overlay videos")(
      "resume", po::bool_switch(&resume),
      "go on from the last checkpoint of a run that was killed or interrupted, to the same bytes; "
      "with -y, one that does not fit is left behind");
  line.operand("SCENE.yaml", &scene);
  if (!line.parse(arguments)) return kDone;
  TrackJob job;
  job.output = line.required_output();
  job.config = line.config();
  job.overlay = !no_overlay;
  job.resume = resume;
  job.overwrite = line.common().overwrite;
  job.command_line = {"walktrack", "track"};
  job.command_line.insert(job.command_line.end(), arguments.begin(), arguments.end());
  job.scene = read_scene(scene);
  Terminal terminal(line.common());
  const JobControl control = terminal.control();
  const TrackOutcome outcome = track_scene(job, control);
  if (!outcome.trouble.empty()) control.say(outcome.trouble);
  if (outcome.resumable) control.say("interrupted; run again with --resume to go on from here");
  control.say(fmt::format("{} of {} frames tracked, {:.1f} frames/s; open {}", outcome.tracked,
                          outcome.frames, outcome.frames_per_second, outcome.look_at.string()));
  return exit_code(outcome.status);
}

}  // namespace walktrack
