#include "model_options.h"

#include <fmt/format.h>

#include "core/errors.h"
#include "io/archive/files.h"
#include "io/scene/model_file.h"

namespace walktrack {

void ModelOptions::declare(CommandLine& line) {
  namespace po = boost::program_options;
  line.options().add_options()(
      "model", po::value(&model_)->value_name("NAME"),
      "monopode, rimless_wheel, anthropomorphic, kneed; for simulate also articulated")(
      "step", po::value(&step_)->default_value(step_, "0.001")->value_name("S"),
      "largest time step, s, 1e-6 to 1")(
      "integrator", po::value(&integrator_)->default_value(integrator_)->value_name("NAME"),
      "euler, rk4 or midpoint");
}

std::string ModelOptions::name(const CommandLine& line) const {
  return model_name(model_, line.common().config_file);
}

ModelSpec ModelOptions::model(const CommandLine& line) const {
  return read_model(model_, line.common().config_file, line.common().settings);
}

SimulationOptions ModelOptions::simulation() const {
  // Events are located to 1e-12 s, so that steps have to be much longer.
  require("--step", step_, 1e-6, 1);
  SimulationOptions options;
  options.max_step = step_;
  if (integrator_ == "euler") {
    options.integrator = Integrator::kEuler;
  } else if (integrator_ == "midpoint") {
    options.integrator = Integrator::kMidpoint;
  } else if (integrator_ != "rk4") {
    throw UsageError(describe({"", 0, "--integrator"}, fmt::format("'{}'", integrator_),
                              "euler, rk4 or midpoint"));
  }
  return options;
}

void ModelOptions::require(const std::string& option, double value, double lowest, double highest) {
  if (value >= lowest && value <= highest) return;
  throw UsageError(describe({"", 0, option}, shortest_number(value),
                            fmt::format("a number from {:g} to {:g}", lowest, highest)));
}

void ModelOptions::require_few(const std::string& option, double time, double piece, double most,
                               const std::string& pieces) {
  if (time / piece <= most) return;
  throw UsageError(describe({"", 0, option},
                            fmt::format("{} s for {} s: {:.3g} {}", shortest_number(piece),
                                        shortest_number(time), time / piece, pieces),
                            fmt::format("at most {:g} {}", most, pieces)));
}

std::vector<std::string> ModelOptions::command_line(const std::string& name,
                                                    const Arguments& arguments) {
  std::vector<std::string> words{"walktrack", name};
  words.insert(words.end(), arguments.begin(), arguments.end());
  return words;
}

}  // namespace walktrack
