// walktrack optimise: cleans the track of another tool.
#include <cmath>

#include <fmt/format.h>

#include "commands.h"
#include "core/errors.h"
#include "io/scene/scene.h"
#include "io/scene/subject_file.h"
#include "jobs/optimise/optimise.h"
#include "terminal.h"

namespace walktrack {

namespace po = boost::program_options;

namespace {

void say(const OptimiseOutcome& outcome, const JobControl& control) {
  fmt::print("{}", changes_text(outcome.changes));
  if (std::abs(outcome.floor_height) >= 0.01)
    control.say(fmt::format(
        "the given feet stood {:.0f} mm {} the floor: the motion was moved there",
        1000 * std::abs(outcome.floor_height), outcome.floor_height > 0 ? "above" : "below"));
  if (outcome.replaced > 0)
    control.say(
        fmt::format("{} joints were far off for a few frames and were replaced", outcome.replaced));
  control.say(fmt::format("{} of {} frames, joints moved by {:.0f} mm on average; open {}",
                          outcome.used, outcome.frames, 1000 * outcome.moved,
                          outcome.open_first.string()));
}

}  // namespace

int run_optimise(const Arguments& arguments) {
  std::string motion, scene;
  double height = 0, mass = 0, joint_sd_mm = 20;
  bool no_overlay = false, ignore_checks = false;
  CommandLine line(
      {.name = "optimise",
       .operands = "MOTION [SCENE.yaml]",
       .about = "Cleans the track of another tool. MOTION (joints.csv, .trc, .c3d, or a result "
                "folder) becomes the\nmotion of a body whose bones keep their lengths and whose "
                "standing feet neither slide nor sink into\nthe floor. With SCENE.yaml it also "
                "fits the videos of that scene, which begin at the motion's time 0.\nWrites the "
                "files of 'track' into the folder --output, and prints what has changed.",
       .example = "walktrack optimise data/demo/truth.csv data/demo/scene.yaml -o out/optimised"});
  auto add = line.options().add_options();
  add("height", po::value(&height)->value_name("M"),
      "stature of the subject; default: that of the scene, otherwise estimated from the lengths of "
      "thighs and shanks");
  add("mass", po::value(&mass)->value_name("KG"),
      "mass of the subject; default: that of the scene, otherwise 70");
  add("joint-sd-mm", po::value(&joint_sd_mm)->value_name("N"),
      "standard deviation of the given joints; default: 20");
  add("no-overlay", po::bool_switch(&no_overlay), "write no overlay videos");
  add("ignore-checks", po::bool_switch(&ignore_checks),
      "continue even if checks of the scene fail (see walktrack check)");
  line.operand("MOTION", &motion);
  line.operand("SCENE.yaml", &scene, true);
  if (!line.parse(arguments)) return kDone;
  if (!(joint_sd_mm >= 0.1 && joint_sd_mm <= 1000))
    throw UsageError(describe({"", 0, "--joint-sd-mm"}, fmt::format("{}", joint_sd_mm),
                              "a number from 0.1 to 1000"));
  OptimiseJob job;
  job.motion = motion;
  if (!scene.empty()) job.scene = read_scene(scene);
  job.height = line.within("height", height, kSmallestHeight, kGreatestHeight);
  job.mass = line.within("mass", mass, kSmallestMass, kGreatestMass);
  job.joint_sd = joint_sd_mm / 1000;
  job.output = line.required_output();
  job.config = line.config();
  job.overwrite = line.common().overwrite;
  job.overlay = !no_overlay;
  job.ignore_checks = ignore_checks;
  job.command_line = {"walktrack", "optimise"};
  job.command_line.insert(job.command_line.end(), arguments.begin(), arguments.end());
  Terminal terminal(line.common());
  const OptimiseOutcome outcome = optimise(job, terminal.control());
  if (outcome.interrupted) return kInterrupted;
  say(outcome, terminal.control());
  return kDone;
}

}  // namespace walktrack
