// walktrack cycle: a limit cycle of a walker and its properties.
#include <fmt/format.h>

#include "commands.h"
#include "core/errors.h"
#include "io/archive/files.h"
#include "io/archive/result_folder.h"
#include "io/scene/model_file.h"
#include "jobs/simulate/simulate_cycle.h"
#include "model_options.h"

namespace walktrack {
namespace {

// Parses "key=value" of --follow.
void set_follow(const std::string& text, CycleJob& job) {
  if (text.empty()) return;
  const size_t equals = text.find('=');
  const auto value =
      equals == std::string::npos ? std::nullopt : number_from_text(text.substr(equals + 1));
  if (!value)
    throw UsageError(describe({"", 0, "--follow"}, fmt::format("'{}'", text), "KEY=NUMBER"));
  job.follow_key = text.substr(0, equals);
  job.follow_to = *value;
}

}  // namespace

int run_cycle(const Arguments& arguments) {
  namespace po = boost::program_options;
  CycleJob job;
  ModelOptions options;
  std::string follow, model_file;
  CommandLine line(
      {.name = "cycle",
       .operands = "",
       .about = "Finds a limit cycle of a walker by Newton's method on its step map, beginning at "
                "the model's start\nstate, and prints fixed point, period, speed, step, cost of "
                "transport and Floquet multipliers.\nWith --output JSON goes to that file and text "
                "to stdout; without it JSON goes to stdout\nand text to stderr.",
       .example = "walktrack cycle --model anthropomorphic --set "
                  "controls.toe_off_impulse=0.07"});
  options.declare(line);
  line.options().add_options()(
      "follow", po::value(&follow)->value_name("KEY=VALUE"),
      "KEY=VALUE: change this parameter to VALUE step by step and follow the cycle")(
      "settle", po::value(&job.settling_steps)->default_value(0)->value_name("N"),
      "steps to walk before Newton's method starts")(
      "max-time",
      po::value(&job.options.max_time)->default_value(job.options.max_time)->value_name("S"),
      "longest time of a step, s")("save-model", po::value(&model_file)->value_name("FILE"),
                                   "write the model with the cycle as its start");
  if (!line.parse(arguments)) return kDone;
  ModelOptions::require("--max-time", job.options.max_time, 1e-6, 1e4);
  line.config_of_run();  // checks --seed and --threads, which a cycle does not depend on
  ModelOptions::require("--settle", job.settling_steps, 0, 1e6);
  job.model = options.model(line);
  job.options.simulation = options.simulation();
  set_follow(follow, job);
  const std::string& output = line.common().output;
  for (const std::string& path : {output, model_file}) {
    if (path.empty()) continue;
    refuse_existing(path, line.common().overwrite);
    refuse_input(path, {line.common().config_file});
  }
  const FoundCycle found = find_cycle(job);
  if (!model_file.empty()) write_file_atomically(model_file, model_as_yaml(found.model));
  if (output.empty()) {
    fmt::print("{}", cycle_json(found));
    if (!line.common().quiet) fmt::print(stderr, "{}", cycle_text(found));
  } else {
    write_file_atomically(output, cycle_json(found));
    fmt::print("{}", cycle_text(found));
  }
  return kDone;
}

}  // namespace walktrack
