// The probability of each colour on the subject: one smoothed colour histogram for each class of
// clothes.
//
//   p(I | class) = (1 - b) h(I) + b broad(I)
// h is a histogram over ColourBins. It is learned from the pixels inside projected parts, each
// weighted by its probability of being foreground, and tends to `broad` while it has seen few
// pixels. `broad` is a wide distribution over brightness and, more loosely, over chroma: it is the
// model of a class that has not been learned, so that a tracker can start without knowing the
// subject's clothes.
//
// Half of a learned model (anchor_share) is estimated from the first frames and never changes; the
// other half adapts slowly. Frames with hardly any foreground are not used.
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

// The broad model of pictures with colours or without.
ColourTable broad_table(const ColourBins& bins, bool colourless = false);

// The learned model of one class.
struct AppearanceState {
  int frames = 0;
  std::vector<float> anchor, recent;  // histograms: shares, sum 1
  double anchor_pixels = 0;
  ColourTable log_density;
};

class AppearanceModel {
 public:
  // For the appearances in `used` (by Appearance); the others have no table.
  AppearanceModel(const ForegroundConfig& config, const std::array<bool, kAppearanceCount>& used,
                  bool colourless = false);

  int classes() const { return static_cast<int>(states_.size()); }
  const std::array<int, kAppearanceCount>& class_of() const { return class_of_; }
  const ColourTable& table(int cls) const { return states_[static_cast<size_t>(cls)].log_density; }
  bool learned(int cls) const { return states_[static_cast<size_t>(cls)].frames > 0; }
  bool any_learned() const;

  // The pixels of one frame: weights[cls][bin] are sums of P(foreground), seen[cls] numbers of
  // pixels.
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
