// The kneed walker's reference values, read from kneed_reference.yaml and kneed_cycles.yaml.
#pragma once

#include <optional>
#include <vector>

#include "walker/kneed/kneed_walker.h"

namespace walktrack {

struct ReferenceState {
  KneedState state;  // stops are set as in the file
  Matrix5 mass_matrix;
  Vector5 qdd_free;
  std::optional<Vector5> qdd_limited;
  Vector2 limit_torque = Vector2::Zero();
  double energy = 0;
  KneedState strike_impulse_0, strike_impulse_20;
};

struct ReferenceFile {
  KneedParameters parameters;
  KneedControls controls;
  std::vector<ReferenceState> states;
};

struct ReferenceCycle {
  double speed = 0, step_length = 0, period = 0;
  KneedControls controls;
  KneedState start;
  double clearance = 0;
};

struct CycleFile {
  KneedParameters parameters;
  std::vector<ReferenceCycle> cycles;
};

ReferenceFile read_kneed_reference();
CycleFile read_kneed_cycles();

}  // namespace walktrack
