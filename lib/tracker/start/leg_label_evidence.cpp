#include "tracker/start/leg_label_evidence.h"

#include <algorithm>

namespace walktrack {
inline namespace tracker {

namespace {

// The errors of pixels in successive frames are correlated: this many nats count as one. Windows of
// made walks with the right labels have -4 to +18 nats. By hand.
constexpr double kPixelTemperature = 3;

// For the terms that distinguish a track's legs.
double frame_log_odds(const TrackerScene& scene, const CameraEvidence& before,
                      const CameraEvidence& now, const Pose& pose_before, const Pose& pose) {
  const Body& body = scene.model.body;
  const PosedBody posed_before(body, pose_before), posed(body, pose);
  double sum = 0;
  Terms::each([&]<typename Term>() {
    if constexpr (kTellsLegsApart<Term>)
      sum += Term::names_log_odds(scene.observation, body, scene.cameras[0], before, now,
                                  posed_before, posed);
  });
  return sum;
}

}  // namespace

double legs_log_odds(const TrackerScene& scene, const std::deque<SceneEvidence>& window,
                     std::span<const FrameRecord> records) {
  double sum = 0;
  for (size_t i = 1; i < std::min(window.size(), records.size()); ++i) {
    if (records[i - 1].tracked && records[i].tracked)
      sum += frame_log_odds(scene, window[i - 1][0], window[i][0], records[i - 1].estimate.pose,
                            records[i].estimate.pose);
  }
  return sum / kPixelTemperature;
}

double names_in_frame(const TrackerScene& scene, const SceneEvidence& evidence, const Pose& pose) {
  // A detector that swaps the legs does so until the legs have passed each other.
  constexpr double kErrsFor = 0.15;  // s; by hand
  if (std::none_of(evidence.begin(), evidence.end(), KeypointTerm::says)) return 0;
  const PosedBody posed(scene.model.body, pose);
  double sum = 0;
  for (size_t c = 0; c < evidence.size(); ++c)
    sum += KeypointTerm::names_log_odds(scene.observation, scene.model.body, scene.cameras[c],
                                        evidence[c], evidence[c], posed, posed);
  return sum * std::min(1.0, scene.dt / kErrsFor);
}

}  // namespace tracker
}  // namespace walktrack
