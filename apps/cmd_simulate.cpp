// walktrack simulate: a walker through time, as tables, pictures and an animation.
#include <fmt/format.h>

#include "commands.h"
#include "io/model_file.h"
#include "jobs/simulate.h"
#include "model_options.h"
#include "terminal.h"

namespace walktrack {

int run_simulate(const Arguments& arguments) {
  namespace po = boost::program_options;
  SimulateJob job;
  ModelOptions options;
  bool no_pictures = false;
  CommandLine line({.name = "simulate",
                    .operands = "",
                    .about = "Simulates a walker. --config names a model file, --set changes one "
                             "value of the model.\nWrites states.csv, events.csv, model.yaml, "
                             "strip.svg, strip.png, animation.mp4 and run.json.",
                    .example = "walktrack simulate --model kneed --duration 3 -o gait"});
  options.declare(line);
  line.options().add_options()("duration", po::value(&job.duration)->default_value(job.duration),
                               "s of simulated time")(
      "steps", po::value(&job.steps)->default_value(0), "stop after so many steps; 0: no limit")(
      "sample", po::value(&job.sample_interval)->default_value(job.sample_interval),
      "s between rows of states.csv")("slow",
                                      po::value(&job.slow_motion)->default_value(job.slow_motion),
                                      "the animation is so many times slower than life")(
      "no-pictures", po::bool_switch(&no_pictures), "tables only");
  if (!line.parse(arguments)) return kDone;
  options.require_positive({{"--duration", job.duration},
                            {"--sample", job.sample_interval},
                            {"--slow", job.slow_motion}});
  job.model = options.model(line);
  job.simulation = options.simulation();
  job.pictures = !no_pictures;
  Terminal terminal(line.common());
  const JobControl control = terminal.control();
  control.say(simulate_into(line.required_output(), line.common().overwrite, job,
                            options.command_line("simulate", arguments), control));
  return kDone;
}

}  // namespace walktrack
