// Decides whether one camera's outlines or its keypoints have more weight.
//
// Distance and size follow from outlines only if the figure has the subject's shape. Arms, girth
// and clothes that the figure lacks change the outline, and poses are then found that cover more of
// it: nearer, crouching, turned. The detector's points have errors of some centimetres whatever
// somebody wears. Therefore an outline's patch gets less weight than one camera's usually has
// (weights_for()) if a start's figure is too thin for the subject and points were detected. This is
// only done with one camera: several cameras show where an outline is wrong.
// tracker/reports/one_camera.md has the measurements.
#pragma once

#include <deque>
#include <span>

#include "tracker/tracker_scene.h"
#include "tracker/walker_filter.h"

namespace walktrack {
inline namespace tracker {

// Factor of the outlines' log-likelihood, and least weight of a point, while keypoints lead: a
// patch of three times the side counts as one pixel, and a point is not tempered. By hand, chosen
// on the two telephones, each alone; a patch of five times the side, or three times the points'
// weight, gives equal results.
inline constexpr double kLedOutlines = 1.0 / 9, kLeadingWeight = 1;
// A figure is too thin if it leaves more than this share of the evidence uncovered (Overlap::missed
// of Overlap::known()): the two telephones and the real side view have .25 to .33, heavy people in
// renders .17 to .34, others .06 to .25 and mostly less than .18.
inline constexpr double kUncovered = 0.2;

// Whether keypoints lead from the beginning, as the configuration states.
bool must_lead(const KeypointConfig& keypoints);

// Whether they lead.
bool keypoints_lead(const ObservationConfig& observation);

// Whether they may lead and do not yet: there is one camera, keypoints are used, and the
// configuration leaves it open.
bool may_lead(const TrackerScene& scene);

// Whether the figure is too thin, and points were detected. `records` of the first frames of
// `window`.
bool figure_is_too_thin(const TrackerScene& scene, const std::deque<SceneEvidence>& window,
                        std::span<const FrameRecord> records);

void let_keypoints_lead(ObservationConfig& observation);

}  // namespace tracker
}  // namespace walktrack
