// walktrack simulate: simulates a walker and writes tables, images and an animation.
#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "commands.h"
#include "core/errors.h"
#include "core/parallel_for.h"
#include "io/archive/files.h"
#include "io/scene/model_file.h"
#include "jobs/prior/prior_walk.h"
#include "jobs/simulate/simulate_articulated.h"
#include "jobs/simulate/simulate_job.h"
#include "jobs/simulate/stability.h"
#include "model_options.h"
#include "terminal.h"

namespace walktrack {
namespace {

// Writes the table of --extremes to --output or stdout.
void write_extremes(const CommandLine& line) {
  line.refuse({"model", "config", "set", "integrator", "step", "duration", "seconds", "steps",
               "sample", "slow", "no-pictures", "prior"},
              "--output, --threads, --yes with --extremes, whose walkers are fixed");
  StabilityJob job;
  job.threads = thread_count(line.config_of_run().values.threads);
  const std::string& output = line.common().output;
  if (!output.empty()) refuse_existing(output, line.common().overwrite);
  line.write_or_print(stability_csv(job, stability_table(job)));
}

// The 3-D body takes the same options as far as they apply to it.
SimulationEnd simulate_articulated(const CommandLine& line, const SimulateJob& shared,
                                   const std::vector<std::string>& command_line) {
  line.refuse({"steps", "prior", "speed", "speed-at", "step-length", "feedback"},
              "options of the articulated body, which does not walk");
  ArticulatedJob job;
  apply_model_settings(entries(job.spec), line.common().config_file, line.common().settings);
  job.model_file = line.common().config_file;
  job.duration = shared.duration;
  job.step = shared.simulation.max_step;
  job.integrator = shared.simulation.integrator;
  job.sample_interval = shared.sample_interval;
  job.slow_motion = shared.slow_motion;
  job.pictures = shared.pictures;
  return simulate_articulated_into(line.required_output(), line.common().overwrite, job,
                                   command_line);
}

// Options of a walk from the table of gaits.
class PriorOptions {
 public:
  void declare(CommandLine& line) {
    namespace po = boost::program_options;
    line.options().add_options()("prior", po::bool_switch(&wanted_),
                                 "take the start and the controls of every step from the table of "
                                 "gaits; for the kneed and the anthropomorphic model, with the "
                                 "body of an adult unless --config or --set says otherwise")(
        "speed", po::value(&speed_)->value_name("M/S"),
        "with --prior: speed of the walk, m/s; default: 1.3")(
        "speed-at", po::value(&changes_)->value_name("T:V"),
        "T:V, with --prior: change the speed to V m/s from T s on; may be repeated")(
        "step-length", po::value(&walk_.step_length)->default_value(0)->value_name("M"),
        "with --prior: step length, m; 0: the step length that people prefer at this speed")(
        "feedback", po::value(&walk_.feedback)->default_value(1)->value_name("SHARE"),
        "strength of the feedback at support transfer, with --prior; 0: none");
  }

  // Kuo's anthropomorphic walker has units of its own; without a named model it is scaled to an
  // adult.
  void apply(SimulateJob& job, const CommandLine& line) {
    const CommonOptions& common = line.common();
    if (!wanted_)
      return line.refuse({"speed", "speed-at", "step-length", "feedback"},
                         "this option together with --prior");
    if (common.config_file.empty() && common.settings.empty())
      job.model.anthropomorphic = adult_straight_walker(1.75, 70);
    for (const std::string& setting : common.settings) refuse_what_the_table_sets(setting);
    if (!std::isnan(speed_)) walk_.speed = speed_;
    for (const std::string& text : changes_) walk_.changes.push_back(change_from(text));
    std::stable_sort(walk_.changes.begin(), walk_.changes.end(),
                     [](const auto& a, const auto& b) { return a.time < b.time; });
    const bool sane = walk_.speed > 0 && walk_.step_length >= 0 && walk_.feedback >= 0 &&
                      std::isfinite(walk_.speed + walk_.step_length + walk_.feedback);
    if (!sane) {
      throw UsageError(
          describe({"", 0, "--speed, --step-length, --feedback"},
                   fmt::format("{}, {}, {}", walk_.speed, walk_.step_length, walk_.feedback),
                   "a speed above 0, the others 0 or more"));
    }
    job = with_prior(std::move(job), walk_);
  }

 private:
  static void refuse_what_the_table_sets(const std::string& setting) {
    for (const char* group : {"controls.", "style.", "start."})
      if (setting.starts_with(group))
        throw UsageError(describe({"", 0, "--set"}, fmt::format("'{}'", setting),
                                  "parameters.* with --prior: everything else is in its table"));
  }

  static SpeedChange change_from(const std::string& text) {
    const size_t colon = std::min(text.find(':'), text.size());
    const auto time = number_from_text(text.substr(0, colon));
    const auto speed =
        colon < text.size() ? number_from_text(text.substr(colon + 1)) : std::nullopt;
    if (time && speed && *time >= 0 && *speed > 0) return {*time, *speed};
    throw UsageError(describe({"", 0, "--speed-at"}, fmt::format("'{}'", text),
                              "SECONDS:METRES_PER_SECOND, such as 5:1.6"));
  }

  bool wanted_ = false;
  double speed_ = std::numeric_limits<double>::quiet_NaN();  // not stated
  WalkPlan walk_;
  std::vector<std::string> changes_;
};

// Refuses sizes that would take too much memory or time.
void check_sizes(const CommandLine& line, const SimulateJob& job) {
  line.config_of_run();  // checks --seed and --threads, which a simulation does not depend on
  if (line.given("duration") && line.given("seconds"))
    throw UsageError(describe({"", 0, "--seconds"}, "--duration as well", "one of them"));
  ModelOptions::require("--duration", job.duration, 1e-6, 1e6);
  ModelOptions::require("--steps", job.steps, 0, 1e9);
  ModelOptions::require("--sample", job.sample_interval, 1e-6, 1e6);
  ModelOptions::require("--slow", job.slow_motion, 1e-3, 1e3);
  ModelOptions::require_few("--step", job.duration, job.simulation.max_step, 1e8, "steps");
  ModelOptions::require_few("--sample", job.duration, job.sample_interval, 1e6, "rows");
  if (job.pictures)
    ModelOptions::require_few("--slow", job.duration, 1 / (job.frame_rate * job.slow_motion), 1e5,
                              "frames of animation");
}

// Reports the outcome; a walker that fell has its own exit code.
int told(const JobControl& control, const SimulationEnd& end) {
  control.say(end.text);
  return end.health == Health::kSound ? kDone : kDegraded;
}

}  // namespace

int run_simulate(const Arguments& arguments) {
  namespace po = boost::program_options;
  SimulateJob job;
  ModelOptions options;
  PriorOptions prior;
  bool no_pictures = false, extremes = false;
  CommandLine line(
      {.name = "simulate",
       .operands = "",
       .about = "Simulates a walker. --config names a model file, --set changes one value of the "
                "model.\nWrites states.csv, events.csv, model.yaml, strip.svg, strip.png, "
                "animation.mp4 and run.json.\nThe exit code is 4 if the walker fell or its "
                "simulation diverged; the files are written in any case.",
       .example =
           "walktrack simulate --model kneed --prior --speed 1.3 --speed-at 5:1.6 -o out/gait"});
  options.declare(line);
  line.options().add_options()(
      "duration", po::value(&job.duration)->default_value(job.duration)->value_name("S"),
      "simulated time, s")("seconds", po::value(&job.duration)->value_name("S"),
                           "the same as --duration")(
      "steps", po::value(&job.steps)->default_value(0)->value_name("N"),
      "stop after so many steps; 0: no limit")(
      "sample",
      po::value(&job.sample_interval)->default_value(job.sample_interval)->value_name("S"),
      "time between rows of states.csv, s; for the articulated body a multiple of --step")(
      "slow", po::value(&job.slow_motion)->default_value(job.slow_motion)->value_name("N"),
      "how many times the animation is slower than reality")(
      "no-pictures", po::bool_switch(&no_pictures), "write tables only")(
      "extremes", po::bool_switch(&extremes),
      "write a table of the errors of every integrator in extreme cases instead (takes minutes)");
  prior.declare(line);
  if (!line.parse(arguments)) return kDone;
  if (extremes) {
    write_extremes(line);
    return kDone;
  }
  job.simulation = options.simulation();
  job.pictures = !no_pictures;
  check_sizes(line, job);
  const auto command_line = options.command_line("simulate", arguments);
  Terminal terminal(line.common());
  const JobControl control = terminal.control();
  if (options.name(line) == "articulated") {
    return told(control, simulate_articulated(line, job, command_line));
  }
  job.model = options.model(line);
  job.model_file = line.common().config_file;
  prior.apply(job, line);
  return told(control, simulate_into(line.required_output(), line.common().overwrite, job,
                                     command_line, control));
}

}  // namespace walktrack
