#include "jobs/track/particle_budget.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/errors.h"

namespace walktrack {
inline namespace jobs {

namespace {

constexpr double kNewShare = 0.1;    // weight of a frame in running means
constexpr double kMostGrowth = 1.5;  // factor from frame to frame, either way
constexpr double kSecondsPerMs = 1e-3;

}  // namespace

ParticleBudget::ParticleBudget(const BudgetConfig& config) : config_(config) {
  if (config.least_particles > config.most_particles)
    throw UsageError(
        describe({"", 0, "budget.least_particles"}, std::to_string(config.least_particles),
                 "at most budget.most_particles, " + std::to_string(config.most_particles)));
}

int ParticleBudget::bounded(double particles) const {
  return static_cast<int>(
      std::clamp(particles, double(config_.least_particles), double(config_.most_particles)));
}

int ParticleBudget::next(int particles, double fixed_seconds, double filter_seconds) {
  const double each = filter_seconds / particles;
  const double share = fixed_ < 0 ? 1 : kNewShare;
  fixed_ = share * fixed_seconds + (1 - share) * std::max(fixed_, 0.0);
  each_ = share * each + (1 - share) * each_;
  const double room = std::max(0.0, kSecondsPerMs * config_.frame_ms - fixed_);
  const double afforded = each_ > 0 ? room / each_ : config_.most_particles;
  const double near = std::clamp(afforded, particles / kMostGrowth, particles * kMostGrowth);
  // Rounded up, so that a growth by half increases even a single particle.
  const double whole = afforded > particles ? std::ceil(near) : std::floor(near);
  return bounded(whole);
}

}  // namespace jobs
}  // namespace walktrack
