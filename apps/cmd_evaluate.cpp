// walktrack evaluate: errors of estimates against a truth.
#include <fmt/format.h>

#include "commands.h"
#include "core/errors.h"
#include "io/archive/files.h"
#include "io/archive/result_folder.h"
#include "jobs/evaluate/evaluate.h"

namespace walktrack {

namespace po = boost::program_options;

int run_evaluate(const Arguments& arguments) {
  std::string truth, uncertainty, plot;
  std::vector<std::string> estimates;
  double frame_rate = 0;
  bool json = false, markdown = false;
  CommandLine line(
      {.name = "evaluate",
       .operands = "TRUTH.csv ESTIMATE [ESTIMATE ...]",
       .about = "Compares estimates (joints.csv, or result folders of 'walktrack track') with a "
                "truth: joints,\nfoot plants (stance,side,on_frame,off_frame,x_m), ground points "
                "(t,x,y) or Pose2Sim key\npoints; the header of the file says which of them it "
                "holds. Prints a Markdown table.",
       .example = "walktrack evaluate data/demo/truth.csv out/demo"});
  auto add = line.options().add_options();
  add("uncertainty", po::value(&uncertainty)->value_name("FILE"),
      "uncertainty.csv of the estimate; default: the file of this name beside the estimate");
  add("frame-rate", po::value(&frame_rate)->value_name("HZ"),
      "frame rate of a truth that states frames instead of times; default: that of the estimate");
  add("json", po::bool_switch(&json), "print JSON");
  add("markdown", po::bool_switch(&markdown), "print a Markdown table (the default)");
  add("plot", po::value(&plot)->value_name("FILE.svg"),
      "write a picture: errors over time and of each joint");
  line.operand("TRUTH.csv", &truth);
  line.operands("ESTIMATE", &estimates);
  if (!line.parse(arguments)) return kDone;
  if (json && markdown) throw UsageError("--json and --markdown exclude each other");
  if (frame_rate < 0) throw UsageError("--frame-rate: allowed is a number above 0");
  EvaluateJob job;
  job.truth = truth;
  job.estimates.assign(estimates.begin(), estimates.end());
  if (!uncertainty.empty()) job.uncertainty = uncertainty;
  if (frame_rate > 0) job.frame_rate = frame_rate;
  std::vector<std::filesystem::path> inputs = job.estimates;
  for (const std::string& folder : estimates)
    for (const char* table : {"joints.csv", "uncertainty.csv", "kinetics.csv"})
      inputs.push_back(std::filesystem::path(folder) / table);
  inputs.insert(inputs.end(), {truth, uncertainty});
  if (!plot.empty()) {
    refuse_existing(plot, line.common().overwrite);
    refuse_input(plot, inputs);
  }
  const auto results = evaluate(job);
  if (!plot.empty()) write_file_atomically(plot, as_svg(truth, results));
  const std::string text = json ? as_json(truth, results) : as_markdown(truth, results);
  line.write_or_print(text, inputs);
  return kDone;
}

}  // namespace walktrack
