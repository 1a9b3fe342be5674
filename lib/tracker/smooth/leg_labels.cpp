#include "tracker/smooth/leg_labels.h"

#include <algorithm>
#include <cmath>

namespace walktrack {
inline namespace tracker {

namespace {

// Log-odds of "swapped" a frame on, when it may have changed with a probability.
double passed_on(double log_odds, double change) {
  const double swapped = 1 / (1 + std::exp(-log_odds));
  const double next = swapped * (1 - change) + (1 - swapped) * change;
  return std::log(next) - std::log1p(-next);
}

double log_odds_of(double probability) {
  constexpr double kSurest = 1e-6;  // against infinite odds
  const double p = std::clamp(probability, kSurest, 1 - kSurest);
  return std::log(p) - std::log1p(-p);
}

double change_within(double dt) { return std::min(0.5, kSwapsPerSecond * dt); }

// One track without a gap.
void judge(std::span<const NamedFrame> frames, double change, std::span<double> out) {
  const size_t count = frames.size();
  std::vector<double> ahead(count);  // log-odds from the frames up to this one
  double log_odds = log_odds_of(frames.front().swapped);
  for (size_t i = 0; i < count; ++i) {
    if (i > 0) log_odds = passed_on(log_odds, change);
    ahead[i] = log_odds -= frames[i].odds;
  }
  double behind = 0;  // from those after it
  for (size_t i = count; i-- > 0;) {
    out[i] = 1 / (1 + std::exp(-(ahead[i] + behind)));
    behind = passed_on(behind - frames[i].odds, change);
  }
}

}  // namespace

std::vector<double> swapped_probabilities(std::span<const NamedFrame> frames, double dt) {
  const double change = change_within(dt);
  std::vector<double> out(frames.size());
  for (size_t begin = 0, end = 0; begin < frames.size(); begin = end + 1) {
    end = begin;
    while (end < frames.size() && frames[end].tracked) ++end;
    if (end > begin)
      judge(frames.subspan(begin, end - begin), change, std::span(out).subspan(begin, end - begin));
  }
  return out;
}

void NamesSoFar::add(const NamedFrame& frame, double dt) {
  if (frame.tracked) {
    log_odds_ = tracked_ ? passed_on(log_odds_, change_within(dt)) : log_odds_of(frame.swapped);
    log_odds_ -= frame.odds;
  }
  tracked_ = frame.tracked;
}

bool NamesSoFar::in_doubt() const {
  // By hand; where nothing more is seen, the chance that a track swaps the legs brings it back in a
  // second.
  constexpr double kDoubt = 0.02;
  return !tracked_ || std::abs(log_odds_) < -log_odds_of(kDoubt);
}

}  // namespace tracker
}  // namespace walktrack
