// walktrack prior: builds the table of gaits, or describes its content.
#include <fmt/format.h>

#include "commands.h"
#include "core/errors.h"
#include "gait/prior/build_straight_prior.h"
#include "jobs/prior/prior.h"
#include "terminal.h"

namespace walktrack {

namespace po = boost::program_options;

namespace {

enum class Model { kKneed, kAnthropomorphic };

Model model_named(const std::string& name) {
  if (name == "kneed") return Model::kKneed;
  if (name == "anthropomorphic") return Model::kAnthropomorphic;
  throw UsageError(
      describe({"", 0, "--model"}, fmt::format("'{}'", name), "kneed, anthropomorphic"));
}

int report(const CommandLine& line, Model model, PriorReportJob job) {
  const Config config = line.config().values;
  job.output = line.required_output();
  job.overwrite = line.common().overwrite;
  job.threads = config.threads;
  job.seed = config.seed;
  Terminal terminal(line.common());
  if (model == Model::kKneed) {
    report_prior(job, terminal.control());
  } else {
    report_straight_prior(job, terminal.control());
  }
  return kDone;
}

int build(const CommandLine& line, Model model, PriorJob job) {
  job.output = line.required_output();
  job.overwrite = line.common().overwrite;
  job.threads = line.config().values.threads;
  Terminal terminal(line.common());
  if (model == Model::kAnthropomorphic) {
    build_straight_prior(job, terminal.control());
    return kDone;
  }
  return build_prior(job, terminal.control()) ? kDone : kInterrupted;
}

}  // namespace

int run_prior(const Arguments& arguments) {
  bool show = false, level = false;
  std::string table, earlier, model = "kneed";
  PriorJob job;
  PriorReportJob shown;
  CommandLine line({.name = "prior",
                    .operands = "",
                    .about = "Builds the table of optimal cyclic gaits over speed, step length and "
                             "slope (half an hour of one\ncore; if it is interrupted, run it again "
                             "to continue). With --show it writes tables and pictures\nof a table "
                             "into a folder. --model anthropomorphic takes one second.",
                    .example = "walktrack prior --show -o out/gaits"});
  line.options().add_options()("show", po::bool_switch(&show), "show a table, build nothing")(
      "model", po::value(&model)->default_value(model)->value_name("NAME"),
      "kneed or anthropomorphic")("table", po::value(&table)->value_name("FILE"),
                                  "the table to show; default: the table of this program")(
      "height", po::value(&shown.height)->value_name("M"), "stature of the person shown")(
      "mass", po::value(&shown.mass)->value_name("KG"), "mass of the person shown")(
      "walkers", po::value(&shown.walkers)->value_name("N"),
      "number of walkers that are simulated to see how long they keep walking")(
      "earlier", po::value(&earlier)->value_name("FILE"),
      "build: keep the valid gaits of this table")("level", po::bool_switch(&level),
                                                   "build: on level ground only")(
      "sweeps", po::value(&job.grid.sweeps)->value_name("N"),
      "build: how often every gait is tried again from its neighbours");
  if (!line.parse(arguments)) return kDone;
  if (show) {
    line.refuse({"earlier", "level", "sweeps"}, "this option without --show, for building a table");
  } else {
    line.refuse({"table", "height", "mass", "walkers"},
                "this option with --show, for showing a table");
  }
  if (!(shown.height > 0.3 && shown.height < 3 && shown.mass > 1 && shown.mass < 500))
    throw UsageError(describe({"", 0, "--height, --mass"},
                              fmt::format("{:g} m, {:g} kg", shown.height, shown.mass),
                              "0.3 to 3 m, 1 to 500 kg"));
  if (job.grid.sweeps < 0 || job.grid.sweeps > 100)
    throw UsageError(fmt::format("--sweeps: found {}, allowed 0 to 100", job.grid.sweeps));
  if (shown.walkers < 1 || shown.walkers > 1'000'000)
    throw UsageError(fmt::format("--walkers: found {}, allowed 1 to 1000000", shown.walkers));
  shown.prior = table;
  job.earlier = earlier;
  const Model walker = model_named(model);
  if (walker == Model::kAnthropomorphic)
    line.refuse({"earlier", "sweeps"}, "this option with --model kneed");
  if (walker == Model::kAnthropomorphic) job.grid.slopes = StraightPriorGrid().slopes;
  if (level) job.grid.slopes = {0};
  return show ? report(line, walker, shown) : build(line, walker, job);
}

}  // namespace walktrack
