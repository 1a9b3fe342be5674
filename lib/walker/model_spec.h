// A planar walker and its start by name: everything that model files in configs/models and `--set`
// can change. Names are dotted: parameters.*, controls.*, style.* and start.*.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "walker/linkage/models.h"
#include "walker/monopode.h"

namespace walktrack {
inline namespace walker {

// The start of a step: just after support transfer, or an apex (monopode).
struct ModelStart {
  std::vector<double> q, qd;  // as the model's coordinates
  double energy = 0;          // J, monopode: > 0 determines the forward speed
};

struct ModelSpec {
  std::string model;  // one of model_names()
  MonopodeParameters monopode;
  RimlessWheelParameters rimless_wheel;
  StraightLeggedParameters anthropomorphic;
  KneedParameters kneed;
  KneedControls controls;
  KneedStyle style;
  ModelStart start;
};

const std::vector<std::string>& model_names();

// A model of that name with parameters and a start for which it walks. UsageError that names the
// nearest model.
ModelSpec default_model(const std::string& name);

// One entry of a model, for reading or writing. Exactly one pointer is set; it points into the
// spec.
struct ModelEntry {
  std::string key;
  std::string comment;  // meaning and unit
  double* number = nullptr;
  bool* flag = nullptr;
  std::vector<double>* list = nullptr;
  double lowest = 0, highest = 0;  // of the number, and of each in the list
  size_t count = 0;                // of the list; 0: any length
};
std::vector<ModelEntry> entries(ModelSpec& spec);

// Creates the walker. UsageError if the start does not fit the model's coordinates.
std::unique_ptr<Walker> make_walker(const ModelSpec& spec);

// (q, qd) of the start. UsageError if the energy is too small.
Eigen::VectorXd start_point(const ModelSpec& spec, const Walker& walker);

// x with the forward rate that gives start.energy if the model states one; otherwise x itself.
// nullopt if the energy is too small.
std::optional<Eigen::VectorXd> at_energy(const ModelSpec& spec, const Eigen::VectorXd& x);

}  // namespace walker
}  // namespace walktrack
