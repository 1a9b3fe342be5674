// The options that simulate and cycle share: the model and its integration.
#pragma once

#include <string>
#include <vector>

#include "command.h"
#include "walker/model_spec.h"
#include "walker/simulate.h"

namespace walktrack {

class ModelOptions {
 public:
  void declare(CommandLine& line);
  // The name that --model or the model file states.
  std::string name(const CommandLine& line) const;
  // The model that --model, --config and --set describe.
  ModelSpec model(const CommandLine& line) const;
  SimulationOptions simulation() const;
  // UsageError if the option's number is not in its range.
  static void require(const std::string& option, double value, double lowest, double highest);
  // UsageError if a time is divided into more pieces than `most`.
  static void require_few(const std::string& option, double time, double piece, double most,
                          const std::string& pieces);
  static std::vector<std::string> command_line(const std::string& name, const Arguments& arguments);

 private:
  std::string model_, integrator_ = "rk4";
  double step_ = 1e-3;
};

}  // namespace walktrack
