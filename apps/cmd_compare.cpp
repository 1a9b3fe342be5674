// walktrack compare: differences between results, or between left and right.
#include <fmt/format.h>

#include "commands.h"
#include "core/errors.h"
#include "jobs/compare/compare.h"
#include "terminal.h"

namespace walktrack {

namespace po = boost::program_options;

int run_compare(const Arguments& arguments) {
  std::vector<std::string> groups;
  std::string unit = "strides";
  size_t draws = CompareJob{}.draws;
  CommandLine line(
      {.name = "compare",
       .operands = "GROUP [GROUP ...]",
       .about = "Compares results of 'walktrack track', 'analyse' or 'batch': joint angles over "
                "the gait cycle and\ngait parameters, with differences from the first group, their "
                "95 % bands by bootstrap over\nstrides, and the minimal detectable change. A group "
                "is a result, a folder with results below it, or\nNAME=FOLDER,FOLDER. With one "
                "group alone its left side is compared with its right side.",
       .example = "walktrack compare out/analysis -o out/sides"});
  auto add = line.options().add_options();
  add("unit", po::value(&unit)->value_name("UNIT"),
      "unit of the bootstrap: strides (if all results are of one person), or trials (each result "
      "counts once: for results of several people or days)");
  add("draws", po::value(&draws)->value_name("N"), "number of bootstrap samples; default: 2000");
  line.operands("GROUP", &groups);
  if (!line.parse(arguments)) return kDone;
  if (unit != "strides" && unit != "trials")
    throw UsageError(fmt::format("--unit: found '{}', allowed: strides, trials", unit));
  if (draws < 100 || draws > 100000)
    throw UsageError(fmt::format("--draws: found {}, allowed: 100 to 100000", draws));
  CompareJob job;
  for (const std::string& group : groups) job.groups.push_back(compare_group(group));
  job.output = line.required_output();
  job.unit = unit == "trials" ? CompareUnit::kTrials : CompareUnit::kStrides;
  job.draws = draws;
  job.seed = line.config().values.seed;
  job.overwrite = line.common().overwrite;
  const CompareOutcome outcome = compare(job);
  const std::string found =
      outcome.compared > 0
          ? fmt::format("{} of {} differences exceed the minimal detectable change",
                        outcome.exceeding, outcome.compared)
          : std::string("too few results or strides for a minimal detectable change");
  Terminal(line.common()).control().say(found + "; open " + outcome.look_at.string());
  return kDone;
}

}  // namespace walktrack
