// What a motion that was changed has gained: the measures of metrics/plausibility.h, and what its
// forces are like (kinetics/kinetics.h), before and after.
#pragma once

#include <string>
#include <vector>

#include "kinetics/kinetics.h"

namespace walktrack {
inline namespace jobs {

// Coefficient of friction of shoes on a floor. By hand: level walking needs .2 to .3.
inline constexpr double kFriction = 0.5;

struct Change {
  std::string name;  // in run.json, followed by _before and _after
  std::string what;  // with its unit
  double before, after;
  int digits;
};

// Both motions at the same times.
std::vector<Change> changes_of(const Motion& before, const Motion& after, const Subject& subject,
                               const Eigen::Vector3d& gravity, const KineticsConfig& config);

// One line for each change, below a heading.
std::string changes_text(const std::vector<Change>& changes);

}  // namespace jobs
}  // namespace walktrack
