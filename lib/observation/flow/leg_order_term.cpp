#include "observation/flow/leg_order_term.h"

#include "observation/flow/leg_order.h"
#include "observation/observed_frame.h"
#include "observation/terms.h"

namespace walktrack {
inline namespace observation {

void LegOrderTerm::Memory::prepare(const ObserverSetting&, ObservedFrame& frame, int,
                                   Prepared&) const {
  if (frame.region.picture && !frame.bgr.empty()) grey_of(frame);
}

void LegOrderTerm::Memory::complete(const ObserverSetting&, ObservedFrame& frame, Prepared&,
                                    CameraEvidence& out) {
  out.picture = {};
  if (frame.region.picture && !frame.bgr.empty()) out.picture = grey_of(frame);
}

bool LegOrderTerm::says(const CameraEvidence& evidence) { return !evidence.picture.pixels.empty(); }

double LegOrderTerm::names_log_odds(const ObservationConfig& config, const Body& body,
                                    const Camera& camera, const CameraEvidence& evidence_before,
                                    const CameraEvidence& evidence, const PosedBody& before,
                                    const PosedBody& now) {
  if (!says(evidence_before) || !says(evidence)) return 0;
  const CapsuleList legs = project_parts(camera, now.parts);
  const PixelRect area = leg_overlap(body.parts, legs);
  if (area.empty()) return 0;
  const FramePair pair = pair_frames(evidence_before.picture, evidence.picture, area);
  const Eigen::Vector2d place = now.skeleton.joints[Joint::kPelvis].head<2>();
  const double at_subject = person_region(camera, place, body.subject.height, 0).metres_per_px;
  const CapsuleList legs_before = project_parts(camera, before.parts);
  return independent_share(config, at_subject) *
         leg_order_log_ratio(body.parts, pair, {legs_before, evidence_before.planes},
                             {legs, evidence.planes});
}

}  // namespace observation
}  // namespace walktrack
