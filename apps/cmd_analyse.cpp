// walktrack analyse: gait, angles and forces of an existing motion.
#include <fmt/format.h>

#include "commands.h"
#include "core/errors.h"
#include "io/scene/subject_file.h"
#include "jobs/evaluate/analyse.h"
#include "terminal.h"

namespace walktrack {

namespace po = boost::program_options;

int run_analyse(const Arguments& arguments) {
  std::string motion;
  double height = 0, mass = 0;
  CommandLine line(
      {.name = "analyse",
       .operands = "MOTION",
       .about = "Computes gait events and parameters, joint angles, ground reactions and joint "
                "moments of a motion\n(joints.csv, or a folder that holds one; z up, ground at z = "
                "0) and writes them into the folder\n--output. 'track' writes the same tables and "
                "the same report, with bands.",
       .example = "walktrack analyse data/demo/truth.csv -o out/analysis"});
  auto add = line.options().add_options();
  add("height", po::value(&height)->value_name("M"),
      "stature of the subject; default: estimated from the lengths of thighs and shanks");
  add("mass", po::value(&mass)->value_name("KG"), "mass of the subject; default: 70");
  line.operand("MOTION", &motion);
  if (!line.parse(arguments)) return kDone;
  AnalyseJob job;
  job.motion = motion;
  job.output = line.required_output();
  job.height = line.within("height", height, kSmallestHeight, kGreatestHeight);
  job.mass = line.within("mass", mass, kSmallestMass, kGreatestMass);
  job.config = line.config();
  job.overwrite = line.common().overwrite;
  job.command_line = {"walktrack", "analyse"};
  job.command_line.insert(job.command_line.end(), arguments.begin(), arguments.end());
  const AnalyseOutcome outcome = analyse(job);
  Terminal(line.common())
      .control()
      .say(fmt::format("{} steps at {:.2f} m/s; open {}", outcome.steps, outcome.speed,
                       outcome.open_first.string()));
  return kDone;
}

}  // namespace walktrack
