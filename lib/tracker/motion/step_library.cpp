#include "tracker/motion/step_library.h"

#include <cmath>

namespace walktrack {
inline namespace tracker {

namespace {

// Of the table of steps. By hand.
constexpr int kSpeeds = 14, kLengths = 5;

LibraryStep booked(const BodyModel& body, const PriorGait& gait) {
  const KneedModel model = on_slope(body, gait.slope);
  LibraryStep step{.aim = {gait.speed, gait.step_length}, .controls = gait.controls, .moments = {}};
  KneedState state = gait.start;
  for (KneedState& moment : step.moments) {
    moment = state;
    kneed_advance(model, gait.controls, Vector5::Zero(), state,
                  gait.period / LibraryStep::kMoments);
  }
  return step;
}

// -1, 0 or 1.
int neighbour(Rng& rng) { return static_cast<int>(rng.uniform() * 3) - 1; }

}  // namespace

StepLibrary::StepLibrary(const BodyModel& model, const GaitPrior& prior)
    : units_(walker_units(model.walker.parameters)), downhill_(model.downhill) {
  slowest_ = prior.speeds.front() * units_.speed();
  speed_step_ = (prior.speeds.back() * units_.speed() - slowest_) / (kSpeeds - 1);
  shortest_ = prior.ratios.front();
  ratio_step_ = (prior.ratios.back() - shortest_) / (kLengths - 1);
  for (const double heading : table_headings(downhill_)) {
    const KneedParameters parameters = in_plane(model, heading).parameters;
    for (int i = 0; i < kSpeeds; ++i) {
      const double speed = slowest_ + i * speed_step_;
      const double preferred = units_.length * preferred_step_length(speed / units_.speed());
      for (int j = 0; j < kLengths; ++j) {
        const double length = (shortest_ + j * ratio_step_) * preferred;
        steps_.push_back(booked(model, gait_at(prior, parameters, speed, length)));
      }
    }
  }
}

const LibraryStep* StepLibrary::near(const StepAim& aim, double heading, Rng& rng) const {
  const double preferred = units_.length * preferred_step_length(aim.speed / units_.speed());
  const long i = std::lround((aim.speed - slowest_) / speed_step_) + neighbour(rng);
  const long j =
      std::lround((aim.step_length / preferred - shortest_) / ratio_step_) + neighbour(rng);
  if (i < 0 || i >= kSpeeds || j < 0 || j >= kLengths) return nullptr;
  const size_t slope = table_heading(downhill_, heading);
  return &steps_[slope * kSpeeds * kLengths + static_cast<size_t>(i * kLengths + j)];
}

}  // namespace tracker
}  // namespace walktrack
