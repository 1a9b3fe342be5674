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
      "monopode, rimless_wheel, anthropomorphic, kneed; simulate also articulated")(
      "step", po::value(&step_)->default_value(step_, "0.001")->value_name("S"),
      "s, largest time step")(
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
  require_positive({{"--step", step_}});
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

void ModelOptions::require_positive(
    const std::vector<std::pair<std::string, double>>& numbers) const {
  for (const auto& [name, value] : numbers) {
    if (value > 0 && value < 1e9) continue;
    throw UsageError(describe({"", 0, name}, shortest_number(value), "a number above 0"));
  }
}

std::vector<std::string> ModelOptions::command_line(const std::string& name,
                                                    const Arguments& arguments) {
  std::vector<std::string> words{"walktrack", name};
  words.insert(words.end(), arguments.begin(), arguments.end());
  return words;
}

}  // namespace walktrack
