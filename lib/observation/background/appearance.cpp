#include "observation/background/appearance.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace walktrack {
inline namespace observation {

namespace {

// Number of frames whose pixels make the anchor, with equal weights. By hand.
constexpr int kAnchorFrames = 10;
// A class learns from a frame only if at least so many of its pixels, and at least this share of
// those seen, were probably foreground: otherwise the pose is wrong or the class is hidden. By
// hand.
constexpr double kLeastPixels = 8, kLeastShare = .3;
// Clothes that look much like the background are foreground with less probability. They are learned
// when another class has its anchor, in frames in which this share of the pixels of all other
// classes is foreground, because then the pose is right, and if more of them is foreground than of
// what is hidden, 2 %. By hand.
constexpr double kOthersShare = .6, kLeastSimilarShare = .1;

// The chroma of clothes, skin and most other things: a Laplace distribution around grey with this
// scale, mixed with a uniform one. By hand; sensitivity not measured. Where all chroma is zero, the
// second scale gives it the density that it has under a background with the least noise
// (BackgroundConfig::noise), so that chroma is evidence for neither.
constexpr double kChromaScale = 25, kColourlessScale = 3, kAnyChroma = .2;

double chroma_density(double chroma, double scale) {
  const double laplace = std::exp(-std::abs(chroma) / scale) / (2 * scale);
  return (1 - kAnyChroma) * laplace + kAnyChroma / 511;
}

double broad_density(const ColourBins& bins, bool colourless, int bin) {
  const double scale = colourless ? kColourlessScale : kChromaScale;
  return chroma_density(bins.middle(bin / kChromaBins % kChromaBins), scale) *
         chroma_density(bins.middle(bin % kChromaBins), scale) / 256;
}

// Smooths with [1 2 1] / 4 along one axis of the histogram, whose neighbours are `step` bins apart;
// shares at the ends stay in their bins.
void smooth(const std::vector<float>& histogram, int length, int step, std::vector<float>& out) {
  for (int block = 0; block < kColourBins; block += length * step) {
    for (int k = 0; k < length; ++k) {
      const float* here = histogram.data() + block + k * step;
      const float* before = k > 0 ? here - step : here;
      const float* after = k < length - 1 ? here + step : here;
      float* to = out.data() + block + k * step;
      for (int i = 0; i < step; ++i) to[i] = 0.25F * before[i] + 0.5F * here[i] + 0.25F * after[i];
    }
  }
}

std::vector<float> smoothed(std::vector<float> histogram) {
  std::vector<float> other(histogram.size());
  smooth(histogram, kLumaBins, kChromaBins * kChromaBins, other);
  smooth(other, kChromaBins, kChromaBins, histogram);
  smooth(histogram, kChromaBins, 1, other);
  return other;
}

void blend(std::vector<float>& into, const std::vector<float>& from, double share) {
  const auto s = static_cast<float>(share);
  for (size_t i = 0; i < into.size(); ++i) into[i] += s * (from[i] - into[i]);
}

}  // namespace

ColourTable broad_table(const ColourBins& bins, bool colourless) {
  ColourTable table(kColourBins);
  for (int bin = 0; bin < kColourBins; ++bin)
    table[static_cast<size_t>(bin)] =
        static_cast<float>(std::log(broad_density(bins, colourless, bin)));
  return table;
}

AppearanceModel::AppearanceModel(const ForegroundConfig& config,
                                 const std::array<bool, kAppearanceCount>& used, bool colourless)
    : config_(config) {
  std::vector<int> labels;  // of the classes in use, in the order of the appearances
  for (size_t a = 0; a < used.size(); ++a) {
    if (!used[a]) continue;
    const auto known = std::find(labels.begin(), labels.end(), config.classes[a]);
    class_of_[a] = static_cast<int>(known - labels.begin());
    if (known == labels.end()) labels.push_back(config.classes[a]);
  }
  const ColourBins bins;
  AppearanceState fresh;
  log_broad_ = broad_table(bins, colourless);
  fresh.log_density = log_broad_;
  states_.assign(labels.size(), fresh);
  for (int bin = 0; bin < kColourBins; ++bin)
    broad_.push_back(static_cast<float>(broad_density(bins, colourless, bin) * bins.volume(bin)));
}

bool AppearanceModel::any_learned() const {
  return std::any_of(states_.begin(), states_.end(),
                     [](const AppearanceState& s) { return s.frames > 0; });
}

AppearanceModel::Counts AppearanceModel::empty_counts() const {
  return {std::vector<std::vector<float>>(states_.size(), std::vector<float>(kColourBins, 0)),
          std::vector<double>(states_.size(), 0)};
}

void AppearanceModel::learn(const ColourBins& bins, const Counts& counts) {
  std::vector<double> totals;
  for (const std::vector<float>& weights : counts.weights)
    totals.push_back(std::accumulate(weights.begin(), weights.end(), 0.0));
  const double all = std::accumulate(totals.begin(), totals.end(), 0.0),
               all_seen = std::accumulate(counts.seen.begin(), counts.seen.end(), 0.0);
  const bool any_anchored = std::ranges::any_of(
      states_, [](const AppearanceState& state) { return state.frames >= kAnchorFrames; });
  for (size_t c = 0; c < states_.size(); ++c) {
    const double total = totals[c], seen = counts.seen[c];
    const bool others_clear = all - total >= kOthersShare * (all_seen - seen) && all_seen > seen;
    const double least = any_anchored && others_clear ? kLeastSimilarShare : kLeastShare;
    if (total < kLeastPixels || total < least * seen) continue;
    std::vector<float> histogram = counts.weights[c];
    for (float& share : histogram) share = static_cast<float>(share / total);
    histogram = smoothed(std::move(histogram));
    AppearanceState& state = states_[c];
    if (state.frames++ == 0) {
      state.anchor = state.recent = histogram;
    } else {
      if (state.frames <= kAnchorFrames) blend(state.anchor, histogram, 1.0 / state.frames);
      blend(state.recent, histogram, std::max(config_.learning_rate, 1.0 / state.frames));
    }
    if (state.frames <= kAnchorFrames) state.anchor_pixels += total;
    refresh(bins, state);
  }
}

void AppearanceModel::refresh(const ColourBins& bins, AppearanceState& state) const {
  const double trust = state.anchor_pixels / (state.anchor_pixels + config_.prior_pixels);
  const double own = (1 - config_.broad_share) * trust;
  const auto others = static_cast<float>(std::log(1 - own));
  for (int bin = 0; bin < kColourBins; ++bin) {
    const auto i = static_cast<size_t>(bin);
    if (state.anchor[i] == 0 && state.recent[i] == 0) {  // true for most bins
      state.log_density[i] = others + log_broad_[i];
      continue;
    }
    const double seen = config_.anchor_share * static_cast<double>(state.anchor[i]) +
                        (1 - config_.anchor_share) * static_cast<double>(state.recent[i]);
    const double share = own * seen + (1 - own) * static_cast<double>(broad_[i]);
    state.log_density[i] = static_cast<float>(std::log(share / bins.volume(bin)));
  }
}

}  // namespace observation
}  // namespace walktrack
