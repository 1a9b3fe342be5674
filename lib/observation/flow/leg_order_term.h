// Which leg is in front, from the motion of the image where the legs overlap (leg_order.h). It is
// not computed for particles: the additional image for each frame is only kept during the search
// for a walk, and whole tracks are tested once for swapped labels.
#pragma once

#include <array>

#include "observation/flow/frame_pair.h"
#include "observation/term.h"

namespace walktrack {
inline namespace observation {

struct LegOrderTerm {
  static constexpr std::string_view kName = "leg order";
  static constexpr TermStage kStage = TermStage::kTracks;
  static constexpr bool kAsksBefore = true;
  static constexpr std::array<TermSwitch, 0> kSwitches{};

  struct Evidence {
    GreyImage picture;  // the whole image; empty unless Region::picture
  };

  struct State {};
  struct Prepared {};

  class Memory {
   public:
    Memory(const ObserverSetting&, ObserverInput&) {}
    void prepare(const ObserverSetting& setting, ObservedFrame& frame, int threads,
                 Prepared& out) const;
    void complete(const ObserverSetting& setting, ObservedFrame& frame, Prepared& prepared,
                  CameraEvidence& out);
    void forget() {}
    static bool learns(const ObservationConfig&) { return false; }
    void learn(const ObserverSetting&, const CameraEvidence&, const FoundPose&) {}
    State state() const { return {}; }
    bool fits(const ObserverSetting&, const State&) const { return true; }
    void resume(const ObserverSetting&, State) {}
  };

  template <typename Groups>
  static void describe(Groups&) {}

  static bool says(const CameraEvidence& evidence);
  static TermCosts cost(const ObservationConfig&, const TermWork&) { return {}; }

  // Log-odds, by two successive frames of one camera, of the legs' labels against the same
  // poses with left and right swapped, nats; not tempered over frames.
  static double names_log_odds(const ObservationConfig& config, const Body& body,
                               const Camera& camera, const CameraEvidence& evidence_before,
                               const CameraEvidence& evidence, const PosedBody& before,
                               const PosedBody& now);
};

}  // namespace observation
}  // namespace walktrack
