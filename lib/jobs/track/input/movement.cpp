#include "jobs/track/input/movement.h"

#include <algorithm>
#include <cmath>

namespace walktrack {
inline namespace jobs {

namespace {

constexpr double kCell = 0.1;          // m
constexpr double kMovementTime = 0.3;  // s; after this time a walker's legs and arms are elsewhere

}  // namespace

MovementWatch::MovementWatch(std::vector<double> metres_per_px, double dt)
    : metres_per_px_(std::move(metres_per_px)),
      frames_(static_cast<size_t>(frames_in(kMovementTime, dt))) {}

double MovementWatch::newly_covered(const SceneEvidence& evidence) {
  std::vector<ForegroundGrid> now;
  double most = 0;
  for (size_t c = 0; c < evidence.size(); ++c) {
    const int cell_px = std::max(2, static_cast<int>(std::lround(kCell / metres_per_px_[c])));
    now.push_back(foreground_grid(evidence[c].planes, cell_px));
    if (before_.size() < frames_) continue;
    const double side = cell_px * metres_per_px_[c];
    most = std::max(most, side * side * walktrack::newly_covered(now[c], before_.front()[c]));
  }
  before_.push_back(std::move(now));
  if (before_.size() > frames_) before_.pop_front();
  return most;
}

}  // namespace jobs
}  // namespace walktrack
