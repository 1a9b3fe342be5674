// How probable each colour is on the walker: one smoothed colour histogram a class of clothes.
//
//   p(I | class) = (1 - b) h(I) + b broad(I)
// h is a histogram over ColourBins, learned from the pixels inside projected parts, each weighted
// by its probability of being foreground, and drawn towards `broad` while it has seen few pixels.
// `broad` expects any brightness and, more loosely, any chroma: it is the model of a class that has
// not been learned, so that a tracker can start without knowing what the walker wears.
//
// Half of a learned model (anchor_share) is what its first frames showed and never changes; the
// other half follows slowly. A frame in which hardly any foreground was found is not learned.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "observation/background/colour.h"
#include "observation/observation_config.h"
#include "observation/silhouette/capsules.h"

namespace walktrack {
inline namespace observation {

// Logs of densities per cubed grey level, by colour bin.
using ColourTable = std::vector<float>;

ColourTable broad_table(const ColourBins& bins);

// What has been learned of one class.
struct AppearanceState {
  int frames = 0;
  std::vector<float> anchor, recent;  // histograms: shares, sum 1
  double anchor_pixels = 0;
  ColourTable log_density;
};

class AppearanceModel {
 public:
  // For the appearances in `used` (by Appearance); the others have no table.
  AppearanceModel(const ForegroundConfig& config, const std::array<bool, kAppearanceCount>& used);

  int classes() const { return static_cast<int>(states_.size()); }
  const std::array<int, kAppearanceCount>& class_of() const { return class_of_; }
  const ColourTable& table(int cls) const { return states_[static_cast<size_t>(cls)].log_density; }
  bool learned(int cls) const { return states_[static_cast<size_t>(cls)].frames > 0; }
  bool any_learned() const;

  // One frame's pixels: weights[cls][bin] sums of P(foreground), seen[cls] the numbers of pixels.
  struct Counts {
    std::vector<std::vector<float>> weights;
    std::vector<double> seen;
  };
  Counts empty_counts() const;
  void learn(const ColourBins& bins, const Counts& counts);

  // By class. A model that resumes the states of another one of the same classes continues like
  // that one.
  const std::vector<AppearanceState>& states() const { return states_; }
  void resume(std::vector<AppearanceState> states) { states_ = std::move(states); }

 private:
  void refresh(const ColourBins& bins, AppearanceState& state) const;

  ForegroundConfig config_;
  std::array<int, kAppearanceCount> class_of_{};
  std::vector<AppearanceState> states_;
  std::vector<float> broad_;  // share of each bin
  ColourTable log_broad_;     // its density
};

}  // namespace observation
}  // namespace walktrack
