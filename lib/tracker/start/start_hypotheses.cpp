#include "tracker/start/start_hypotheses.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/log_weights.h"
#include "tracker/moves/mirror_legs.h"

namespace walktrack {
inline namespace tracker {

namespace {

// A hypothesis this many nats behind the best has lost (odds of 1 to 3 million).
// By hand.
constexpr double kHopeless = 15;
// The evidence of a few particles is itself uncertain. In 25 starts (side views from near and from
// afar, two cameras; reports/left_and_right.md) the best hypothesis was wrong as often as if this
// many nats counted as one.
constexpr double kEvidenceTemperature = 50;

}  // namespace

StartHypotheses::StartHypotheses(const MotionContext& motion, const StartConfig& start,
                                 const FilterConfig& filter, const DetectedWalk& detected,
                                 const std::vector<PhaseRange>& ranges, uint64_t seed, int threads)
    : filter_(filter), seed_(seed), frames_to_decide_(frames_in(start.seconds, motion.dt)) {
  FilterConfig small = filter;
  small.particles = start.particles;
  if (detected.standing) {  // standing has no phase
    hypotheses_.push_back({WalkerFilter(filter, seed, threads), seed, 0, {}, false});
    StartConfig all = start;
    all.particles = filter.particles;
    hypotheses_.back().filter.start(spawn(motion, all, detected, {}, seed));
    return;
  }
  for (const PhaseRange& range : ranges) {
    // Separate streams of random numbers.
    const uint64_t own = seed + 0x9E3779B97F4A7C15u * (hypotheses_.size() + 1);
    hypotheses_.push_back({WalkerFilter(small, own, threads), own, 0, {}, false});
    hypotheses_.back().filter.start(spawn(motion, start, detected, range, own));
  }
}

const StartHypotheses::Hypothesis& StartHypotheses::leader() const {
  return *std::max_element(
      hypotheses_.begin(), hypotheses_.end(), [](const Hypothesis& a, const Hypothesis& b) {
        return a.rejected != b.rejected ? a.rejected : a.log_evidence < b.log_evidence;
      });
}

bool StartHypotheses::step(const WalkerFilterContext& context, const SceneEvidence& evidence,
                           uint32_t frame) {
  for (Hypothesis& each : hypotheses_) {
    each.records.push_back(advance(context, evidence, frame, each.seed, frames_ == 0, each.filter));
    each.log_evidence += each.records.back().filter.log_evidence;
    if (context.scene.cameras.size() > 1)
      relabel_before_switch(context.scene.model.body, each.records);
  }
  ++frames_;
  const double best = leader().log_evidence;
  if (best == -std::numeric_limits<double>::infinity()) return false;
  for (Hypothesis& each : hypotheses_)
    each.rejected = each.rejected || each.log_evidence < best - kHopeless;
  const std::optional<uint64_t> kept = mirror_hypothesis();
  std::erase_if(hypotheses_,
                [&](const Hypothesis& each) { return each.rejected && each.seed != kept; });
  weigh_modes();
  return true;
}

// The best hypothesis whose legs are swapped relative to the leader: it is kept, so that the
// probability of swapped legs is known.
std::optional<uint64_t> StartHypotheses::mirror_hypothesis() const {
  const double phase = leader().records.back().modes.phase;
  const Hypothesis* best = nullptr;
  for (const Hypothesis& each : hypotheses_) {
    const bool alive = each.log_evidence > -std::numeric_limits<double>::infinity();
    if (!alive || !apart(phase, each.records.back().modes.phase)) continue;
    if (!best || each.log_evidence > best->log_evidence) best = &each;
  }
  return best ? std::optional(best->seed) : std::nullopt;
}

// For the newest frame: the probability of hypotheses with swapped legs, relative to this one.
void StartHypotheses::weigh_modes() {
  std::vector<double> evidence, phases;
  for (const Hypothesis& each : hypotheses_) {
    evidence.push_back(each.log_evidence / kEvidenceTemperature);
    phases.push_back(each.records.back().modes.phase);
  }
  const std::vector<double> share = normalised_weights(evidence);
  for (Hypothesis& each : hypotheses_) {
    StrideModes& modes = each.records.back().modes;
    modes.p_legs_swapped = mass_apart(modes.phase, phases, share);
  }
}

std::vector<WalkerParticle> StartHypotheses::resampled() const {
  std::vector<double> evidence;
  for (const Hypothesis& each : hypotheses_)
    evidence.push_back(each.rejected ? -std::numeric_limits<double>::infinity()
                                     : each.log_evidence);
  const std::vector<double> share = normalised_weights(evidence);
  std::vector<const WalkerParticle*> states;
  std::vector<double> log_weights;
  for (size_t h = 0; h < hypotheses_.size(); ++h) {
    if (hypotheses_[h].rejected) continue;
    const auto& set = hypotheses_[h].filter.particles();
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

}  // namespace tracker
}  // namespace walktrack
