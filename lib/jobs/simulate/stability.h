// The kneed walker in extreme cases: the errors of each integrator for time steps, stiffness, mass
// ratios, slopes and degenerate postures. Every cell of the table is one of three words, and never
// NaN:
//   accurate   ends within `tolerance` of the reference in every angle, with the same outcome
//   degraded   ends valid or fallen, but with a larger error
//   diverged   the divergence was reported
#pragma once

#include <string>
#include <vector>

#include "mechanics/integrator.h"

namespace walktrack {
inline namespace jobs {

struct StabilityJob {
  std::vector<double> steps{1e-5, 1e-4, 1e-3, 1.0 / 240, 1.0 / 60, 1.0 / 30, 1.0 / 15};  // s
  double duration = 0.7;         // s: one step with its knee stop and its strike
  double reference_step = 1e-5;  // s; RK4, or the midpoint rule where that diverges
  double tolerance = 1e-3;       // rad
  int threads = 1;
};

struct StabilityRow {
  std::string scenario;
  Integrator integrator;
  std::vector<std::string> words;  // one for each step size
  std::vector<double> errors;      // rad, largest difference of an angle; -1 where diverged
};

std::vector<StabilityRow> stability_table(const StabilityJob& job);

// Scenario, integrator, then the word and the error of every step size.
std::string stability_csv(const StabilityJob& job, const std::vector<StabilityRow>& rows);

}  // namespace jobs
}  // namespace walktrack
