// walktrack simulate: a walker through time, as tables, pictures and an animation.
#include <fmt/format.h>

#include "commands.h"
#include "core/parallel_for.h"
#include "io/files.h"
#include "io/model_file.h"
#include "jobs/articulated.h"
#include "jobs/simulate.h"
#include "jobs/stability.h"
#include "model_options.h"
#include "terminal.h"

namespace walktrack {
namespace {

// The table of --extremes, to --output or stdout.
void write_extremes(const CommandLine& line) {
  StabilityJob job;
  job.threads = hardware_threads();
  const std::string& output = line.common().output;
  if (!output.empty()) refuse_existing(output, line.common().overwrite);
  const std::string table = stability_csv(job, stability_table(job));
  if (output.empty()) {
    fmt::print("{}", table);
  } else {
    write_file_atomically(output, table);
  }
}

// The body in 3-D takes the same options as far as they mean something to it.
std::string simulate_articulated(const CommandLine& line, const SimulateJob& shared,
                                 const std::vector<std::string>& command_line) {
  ArticulatedJob job;
  apply_model_settings(entries(job.spec), line.common().config_file, line.common().settings);
  job.duration = shared.duration;
  job.step = shared.simulation.max_step;
  job.integrator = shared.simulation.integrator;
  job.sample_interval = shared.sample_interval;
  job.pictures = shared.pictures;
  return simulate_articulated_into(line.required_output(), line.common().overwrite, job,
                                   command_line);
}

}  // namespace

int run_simulate(const Arguments& arguments) {
  namespace po = boost::program_options;
  SimulateJob job;
  ModelOptions options;
  bool no_pictures = false, extremes = false;
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
      "no-pictures", po::bool_switch(&no_pictures), "tables only")(
      "extremes", po::bool_switch(&extremes),
      "instead: a table of how each integrator fares at the extremes (minutes)");
  if (!line.parse(arguments)) return kDone;
  if (extremes) {
    write_extremes(line);
    return kDone;
  }
  options.require_positive({{"--duration", job.duration},
                            {"--sample", job.sample_interval},
                            {"--slow", job.slow_motion}});
  job.simulation = options.simulation();
  job.pictures = !no_pictures;
  const auto command_line = options.command_line("simulate", arguments);
  Terminal terminal(line.common());
  const JobControl control = terminal.control();
  if (options.name(line) == "articulated") {
    control.say(simulate_articulated(line, job, command_line));
    return kDone;
  }
  job.model = options.model(line);
  control.say(
      simulate_into(line.required_output(), line.common().overwrite, job, command_line, control));
  return kDone;
}

}  // namespace walktrack
