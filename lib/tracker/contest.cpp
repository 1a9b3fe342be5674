#include "tracker/contest.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <utility>

#include "core/log_weights.h"

namespace walktrack {

namespace {

// A hypothesis this many nats behind the best of its half of the stride has lost (odds of 1 to 3
// million), and a rival this many behind the best: evidence from sets of particles is noisy.
constexpr double kHopeless = 15, kHopelessRival = 60;

int frames_in(double seconds, double dt) {
  return std::max(2, static_cast<int>(std::lround(seconds / dt)));
}

}  // namespace

Contest::Contest(const MotionContext& motion, const StartConfig& start, const FilterConfig& filter,
                 const Sighting& sighting, std::optional<double> stride_phase, uint64_t seed,
                 int threads)
    : start_(start),
      filter_(filter),
      seed_(seed),
      threads_(threads),
      first_round_(frames_in(start.seconds, motion.dt)),
      second_round_(frames_in(start.rival_seconds, motion.dt)) {
  FilterConfig small = filter;
  small.particles = start.particles;
  const auto ranges = stride_phase ? phase_ranges(start, *stride_phase) : phase_ranges(start);
  phases_ = static_cast<int>(ranges.size());
  for (int k = 0; k < phases_; ++k) {
    const uint64_t own = seed + 0x9E3779B97F4A7C15u * static_cast<uint64_t>(k + 1);
    hypotheses_.push_back({WalkerFilter(small, own, threads), own, k, 0, {}});
    hypotheses_.back().filter.start(
        spawn(motion, start, sighting, ranges[static_cast<size_t>(k)], own));
  }
}

const Contest::Hypothesis& Contest::leader() const {
  return *std::max_element(
      hypotheses_.begin(), hypotheses_.end(),
      [](const Hypothesis& a, const Hypothesis& b) { return a.log_evidence < b.log_evidence; });
}

bool Contest::rivals(int phase, int other) const {
  const int apart = std::abs(phase - other);
  return 4 * std::min(apart, phases_ - apart) > phases_;
}

bool Contest::step(const WalkerFilterContext& context, const SceneEvidence& evidence,
                   uint32_t frame) {
  for (Hypothesis& each : hypotheses_) {
    each.records.push_back(advance(context, evidence, frame, each.seed, frames_ == 0, each.filter));
    each.log_evidence += each.records.back().filter.log_evidence;
  }
  ++frames_;
  if (leader().log_evidence == -std::numeric_limits<double>::infinity()) return false;
  drop_hopeless();
  if (frames_ == first_round_) keep_two();
  decided_ = frames_ >= first_round_ &&
             (hypotheses_.size() == 1 || frames_ >= first_round_ + second_round_);
  return true;
}

void Contest::drop_hopeless() {
  const int phase = leader().phase;
  const double best = leader().log_evidence;
  double best_rival = -std::numeric_limits<double>::infinity();
  for (const Hypothesis& each : hypotheses_)
    if (rivals(each.phase, phase)) best_rival = std::max(best_rival, each.log_evidence);
  const bool two_left = frames_ > first_round_;
  std::erase_if(hypotheses_, [&](const Hypothesis& each) {
    if (!rivals(each.phase, phase)) return each.log_evidence < best - kHopeless;
    const double least = two_left ? best - kHopelessRival : best_rival - kHopeless;
    return !(each.log_evidence >= least);
  });
}

// What is left on each side of the stride becomes one hypothesis.
void Contest::keep_two() {
  std::array<std::vector<const Hypothesis*>, 2> side;
  const int phase = leader().phase;
  for (const Hypothesis& each : hypotheses_)
    side[rivals(each.phase, phase) ? 1 : 0].push_back(&each);
  std::vector<Hypothesis> kept;
  for (const auto& members : side) {
    if (members.empty()) continue;
    const Hypothesis& best = **std::max_element(
        members.begin(), members.end(),
        [](const Hypothesis* a, const Hypothesis* b) { return a->log_evidence < b->log_evidence; });
    WalkerFilter filter(filter_, best.seed, threads_);
    filter.start(drawn(members));
    kept.push_back({std::move(filter), best.seed, best.phase, best.log_evidence, best.records});
  }
  hypotheses_ = std::move(kept);
}

std::vector<WalkerParticle> Contest::drawn(const std::vector<const Hypothesis*>& from) const {
  std::vector<double> evidence;
  for (const Hypothesis* each : from) evidence.push_back(each->log_evidence);
  const std::vector<double> share = normalised_weights(evidence);
  std::vector<const WalkerParticle*> states;
  std::vector<double> log_weights;
  for (size_t h = 0; h < from.size(); ++h) {
    const auto& set = from[h]->filter.particles();
    const double total = log_sum_exp(set.log_weights);
    for (size_t i = 0; i < set.states.size(); ++i) {
      states.push_back(&set.states[i]);
      log_weights.push_back(set.log_weights[i] - total + std::log(share[h]));
    }
  }
  std::vector<uint32_t> parents(static_cast<size_t>(filter_.particles));
  const auto frame = static_cast<uint32_t>(frames_);
  systematic_resample(log_weights, Rng(seed_, Purpose::kInitialisation, frame).uniform(), parents);
  std::vector<WalkerParticle> chosen;
  chosen.reserve(parents.size());
  for (const uint32_t parent : parents) chosen.push_back(*states[parent]);
  return chosen;
}

double Contest::support() const {
  double sum = 0;
  for (const FrameRecord& record : records()) sum += record.support;
  return frames_ > 0 ? sum / frames_ : 0;
}

std::vector<WalkerParticle> Contest::survivors() const {
  std::vector<const Hypothesis*> left;
  for (const Hypothesis& each : hypotheses_) left.push_back(&each);
  return drawn(left);
}

}  // namespace walktrack
