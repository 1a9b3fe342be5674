// Foreground against background: the sum of log-ratios over the visible silhouette,
//   w sum of log p(I | foreground) - log p(I | background),
// where w is the number of independent pixels that a pixel represents.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "observation/background/appearance.h"
#include "observation/background/background.h"
#include "observation/background/seen_colours.h"
#include "observation/silhouette/planes.h"
#include "observation/term.h"

namespace walktrack {
inline namespace observation {

struct SilhouetteTerm {
  static constexpr std::string_view kName = "silhouettes";
  static constexpr TermStage kStage = TermStage::kEarly;
  static constexpr bool kAsksBefore = false;
  static constexpr std::array kSwitches{
      TermSwitch{"background", "background", "how the empty scene looks",
                 [](const ObservationConfig& c) { return c.background.enabled; }},
      TermSwitch{"foreground", "appearance", "how the walker looks, learned on the way",
                 [](const ObservationConfig& c) { return c.foreground.enabled; }}};

  struct Evidence {
    LogRatioPlanes planes;  // empty if foreground and background are both off
    SeenColours colours;    // empty unless Region::picture and the clothes are not known yet
  };

  struct State {
    std::optional<BackgroundModel> background;
    std::vector<AppearanceState> appearance;
    ColourTable scene;   // the colours of the first image; only without a background
    int64_t frames = 0;  // with an image
  };

  struct Prepared {
    ColourPatch colours;        // of the region and its border
    double gain = 1;            // brightness of the light; 1 without a background
    std::vector<float> behind;  // log densities under the background, row by row of the area
  };

  class Memory {
   public:
    // InputError if the background is enabled and missing or of another size.
    Memory(const ObserverSetting& setting, ObserverInput& input);
    void prepare(const ObserverSetting& setting, ObservedFrame& frame, int threads,
                 Prepared& out) const;
    void complete(const ObserverSetting& setting, ObservedFrame& frame, Prepared& prepared,
                  CameraEvidence& out);
    void forget() {}
    static bool learns(const ObservationConfig& config) { return config.foreground.enabled; }
    void learn(const ObserverSetting& setting, const CameraEvidence& evidence,
               const FoundPose& found);
    State state() const;
    bool fits(const ObserverSetting& setting, const State& state) const;
    void resume(const ObserverSetting& setting, State state);

   private:
    int planes_wanted(const ObservationConfig& config) const;
    void fill_planes(const ObserverSetting& setting, const ObservedFrame& frame,
                     const Prepared& prepared, LogRatioPlanes& planes);
    void fill_rows(const ObserverSetting& setting, const Prepared& prepared, int begin, int end,
                   LogRatioPlanes& planes) const;
    bool knows_colours(const ObservationConfig& config) const;
    uint16_t bin_of(const ColourPatch& patch, size_t index) const;
    SeenColours seen_colours(const ObserverSetting& setting, const ObservedFrame& frame,
                             const Prepared& prepared) const;

    std::optional<BackgroundModel> background_;
    AppearanceModel appearance_;
    ColourBins bins_;
    ColourTable scene_;  // only without a background model
    ColourTable broad_;
    int64_t frames_ = 0;
    ColourPatch patch_;  // of the last frame
  };

  template <typename Groups>
  static void describe(Groups& groups);

  static bool says(const CameraEvidence& evidence);
  static double log_likelihood(const ObservationConfig& config, const CameraEvidence& evidence,
                               const Camera& camera, const PosedBody& now, const PosedBody* before);
  static TermCosts cost(const ObservationConfig& config, const TermWork& work);
};

template <typename Groups>
void SilhouetteTerm::describe(Groups& groups) {
  using B = BackgroundConfig;
  auto b =
      groups.group("background", "the model of the empty scene", &ObservationConfig::background);
  b.flag("enabled", &B::enabled, "whether the background is modelled");
  b.integer("samples", &B::samples, 1, 10'000, "frames from which the model is made");
  b.setting(
      "without_people", &B::without_people,
      "whether people found by the pose network are left out of a model learned from the video");
  b.number("noise", &B::noise, 0.1, 255,
           "smallest standard deviation of a channel, grey levels of 256");
  b.number("jitter_px", &B::jitter_px, 0, 100,
           "movement of edges from frame to frame, px of the shrunk image");
  b.number("shadow_darkest", &B::shadow_darkest, 0, 0.99,
           "share of its brightness that a pixel keeps in the darkest shadow");
  b.number("shadow_share", &B::shadow_share, 0, 0.8, "prior probability of a shadow");
  b.number("shadow_tint", &B::shadow_tint, 0.1, 255,
           "standard deviation of a shadow's chroma, grey levels");
  b.number("shadow_sky", &B::shadow_sky, 0, 1,
           "additional deviation of the chroma per grey level by which a shadow darkens");
  b.number("gradient_weight", &B::gradient_weight, 0, 1,
           "weight of the luma gradient relative to the colour");
  b.number("unknown_share", &B::unknown_share, 1e-6, 0.1,
           "prior probability that the background looks like nothing seen before");
  b.number("drift_rate", &B::drift_rate, 0, 1,
           "share of a new frame with which the model is updated");

  using F = ForegroundConfig;
  constexpr double kAnyPositive = 1e9;
  auto f = groups.group("foreground", "the subject's appearance", &ObservationConfig::foreground);
  f.flag("enabled", &F::enabled, "whether appearance is modelled");
  f.list("classes", &F::classes, 0, kAppearanceCount - 1,
         "models of trunk, legs, feet, head, arms; equal numbers share one");
  f.number("broad_share", &F::broad_share, 0, 1, "share of a component that expects any colour");
  f.number("prior_pixels", &F::prior_pixels, 0, kAnyPositive,
           "weight of the prior over colours, pixels");
  f.number("learning_rate", &F::learning_rate, 0, 1,
           "share of a new frame in the recent part of the model");
  f.number("anchor_share", &F::anchor_share, 0, 1,
           "share of the part learned from the first frames, which is kept");
}

}  // namespace observation
}  // namespace walktrack
