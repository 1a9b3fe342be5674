// The options that simulate and cycle share: which model and how it is integrated.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "command.h"
#include "walker/model_spec.h"
#include "walker/simulate.h"

namespace walktrack {

class ModelOptions {
 public:
  void declare(CommandLine& line);
  // What --model or the model file says.
  std::string name(const CommandLine& line) const;
  // The model that --model, --config and --set describe.
  ModelSpec model(const CommandLine& line) const;
  SimulationOptions simulation() const;
  // UsageError where a number is not above zero.
  void require_positive(const std::vector<std::pair<std::string, double>>& numbers) const;
  static std::vector<std::string> command_line(const std::string& name, const Arguments& arguments);

 private:
  std::string model_, integrator_ = "rk4";
  double step_ = 1e-3;
};

}  // namespace walktrack
