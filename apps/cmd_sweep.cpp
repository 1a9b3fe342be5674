// walktrack sweep: measures accuracy against time.
#include <fmt/format.h>

#include "commands.h"
#include "core/errors.h"
#include "jobs/sweep/sweep.h"
#include "terminal.h"

namespace walktrack {

namespace po = boost::program_options;

namespace {

constexpr const char* kDefaultOver = "particles=75:150:300,scale=60:120";

struct SweepOptions {
  std::string scene, truth;
  std::vector<std::string> over;
  int seeds = 3, repeats = 1;
  double fps = 0, error_mm = 0;
};

void declare(CommandLine& line, SweepOptions& options) {
  auto add = line.options().add_options();
  add("over", po::value(&options.over)->composing()->value_name("NAME=V:V,..."),
      "parameters and their values: particles, scale (height of a person, px), terms "
      "(background+foreground+flow+keypoints), cameras (how many, or names joined by +), moves, "
      "layers, "
      "arms, keypoints (off:on), model, path, config (files or presets), or any key of 'walktrack "
      "config'; default particles=75:150:300,scale=60:120");
  add("seeds", po::value(&options.seeds)->value_name("N"),
      "number of seeds for each setting; default 3");
  add("repeats", po::value(&options.repeats)->value_name("N"),
      "number of times that each run is repeated to measure its time; default 1");
  add("truth", po::value(&options.truth)->value_name("FILE"),
      "truth against which errors are measured; default: the truth of the scene, otherwise a run "
      "with the most accurate setting");
  add("want-fps", po::value(&options.fps)->value_name("N"),
      "recommend a setting for this many frames/s");
  add("want-error-mm", po::value(&options.error_mm)->value_name("MM"),
      "recommend a setting for an error of at most this value");
  line.operand("SCENE.yaml", &options.scene);
}

void refuse_below(const char* option, double value, double least) {
  if (!(value >= least))
    throw UsageError(describe({"", 0, option}, fmt::format("{:g}", value),
                              fmt::format("a number from {:g}", least)));
}

}  // namespace

int run_sweep(const Arguments& arguments) {
  SweepOptions options;
  CommandLine line(
      {.name = "sweep",
       .operands = "SCENE.yaml",
       .about = "Measures what accuracy costs: tracks the scene with every combination of settings "
                "and several\nseeds, and writes error, lost frames and speed of each as a table "
                "and a picture, with the settings\nfor which no other setting is both faster and "
                "more accurate, and a recommendation. If it is run\nagain, it measures only what "
                "is missing; -y measures everything again.",
       .example = "walktrack sweep data/demo/scene.yaml -o out/sweep --over particles=50:100 "
                  "--seeds 2"});
  declare(line, options);
  if (!line.parse(arguments)) return kDone;
  refuse_below("--seeds", options.seeds, 1);
  refuse_below("--repeats", options.repeats, 1);
  refuse_below("--want-fps", options.fps, 0);
  refuse_below("--want-error-mm", options.error_mm, 0);
  SweepJob job;
  job.output = line.required_output();
  job.config = line.config();
  job.scene = read_scene(options.scene);
  if (options.over.empty()) options.over.emplace_back(kDefaultOver);
  job.parameters = swept_parameters(options.over, job.scene, job.config);
  job.seeds = options.seeds;
  job.repeats = options.repeats;
  job.truth = options.truth;
  job.again = line.common().overwrite;
  Terminal terminal(line.common());
  const SweepReport report = run_sweep(job, terminal.control());
  SweepWish wish;
  if (options.fps > 0) wish.frames_per_second = options.fps;
  if (options.error_mm > 0) wish.error_mm = options.error_mm;
  const std::vector<std::string> advice = sweep_advice(report, wish);
  write_sweep(report, advice, job);
  fmt::print("{}", sweep_markdown(report, advice));
  return kDone;
}

}  // namespace walktrack
