// Optical flow: the agreement of this frame with the previous one along the motion of a pose
// (flow.h).
#pragma once

#include <array>

#include "observation/flow/flow.h"
#include "observation/term.h"

namespace walktrack {
inline namespace observation {

inline bool is_on(const FlowConfig& config) { return config.enabled == TermSetting::kOn; }

struct FlowTerm {
  static constexpr std::string_view kName = "flow";
  static constexpr TermStage kStage = TermStage::kLate;
  static constexpr bool kAsksBefore = true;
  static constexpr std::array kSwitches{
      TermSwitch{"flow", "flow", "how the pixels move",
                 [](const ObservationConfig& c) { return is_on(c.flow); }}};

  struct Evidence {
    FlowField flow;  // empty if flow is off or there is no previous frame
  };

  struct State {
    GreyImage grey_before;  // the previous frame; empty = none
  };

  struct Prepared {
    FlowField flow;
  };

  class Memory {
   public:
    Memory(const ObserverSetting&, ObserverInput&) {}
    void prepare(const ObserverSetting& setting, ObservedFrame& frame, int threads,
                 Prepared& out) const;
    void complete(const ObserverSetting& setting, ObservedFrame& frame, Prepared& prepared,
                  CameraEvidence& out);
    void forget() { state_ = {}; }
    static bool learns(const ObservationConfig&) { return false; }
    void learn(const ObserverSetting&, const CameraEvidence&, const FoundPose&) {}
    State state() const { return state_; }
    bool fits(const ObserverSetting& setting, const State& state) const;
    void resume(const ObserverSetting&, State state) { state_ = std::move(state); }

   private:
    State state_;
  };

  template <typename Groups>
  static void describe(Groups& groups);

  static bool says(const CameraEvidence& evidence);
  static double log_likelihood(const ObservationConfig& config, const CameraEvidence& evidence,
                               const Camera& camera, const PosedBody& now, const PosedBody* before);
  static TermCosts cost(const ObservationConfig& config, const TermWork& work);
};

template <typename Groups>
void FlowTerm::describe(Groups& groups) {
  using W = FlowConfig;
  auto w = groups.group("flow", "optical flow", &ObservationConfig::flow);
  w.setting(
      "enabled", &W::enabled,
      "whether the motion between frames is compared; auto: off, no measurement shows a gain");
  w.number("error_px", &W::error_px, 0, 1000, "error of the flow of pixels at rest, px");
  w.number("error_share", &W::error_share, 0, 10,
           "additional error of moving pixels, as a share of their motion");
  w.number("noise", &W::noise, 0.01, 255,
           "noise of a pixel from frame to frame, grey levels of 256");
  w.number("dof", &W::dof, 0.5, 1000,
           "degrees of freedom of the Student-t; fewer expect more outliers");
  w.number("weight", &W::weight, 0, 1000, "weight relative to the silhouettes");
}

}  // namespace observation
}  // namespace walktrack
