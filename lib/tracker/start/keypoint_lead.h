// Decides whether one camera's outlines or its keypoints have more weight.
//
// Distance and size follow from outlines only if the figure has the subject's shape. Arms, girth
// and clothes that the figure lacks change the outline, and poses are then found that cover more of
// it: nearer, crouching, turned. The detector's points have errors of some centimetres whatever
// somebody wears. Therefore an outline's patch gets less weight than one camera's usually has
// (weights_for()) if a start's figure covers the subject badly, points were detected, and the walk
// is along the viewing ray, where place and steps depend on size. Across the ray outlines determine
// the place. tracker/reports/one_camera.md has the measurements. This is only done with one camera:
// several cameras show where an outline is wrong.
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
// A mean overlap (observation/silhouette/overlap.h) below this is bad: the two telephones and the
// real side view have .67 to .69, walks of two renderers .75 to .84.
inline constexpr double kBadOverlap = 0.72;

// More along the ray than across it.
inline constexpr double kAlongRay = 0.7;  // cosine

// Whether keypoints lead from the beginning, as the configuration states.
bool must_lead(const KeypointConfig& keypoints);

// Whether they lead.
bool keypoints_lead(const ObservationConfig& observation);

// Whether they may lead and do not yet: there is one camera, keypoints are used, the configuration
// leaves it open, and the subject walks towards the camera or away from it.
bool may_lead(const TrackerScene& scene, const DetectedWalk& walk);

// `records` of the first frames of `window`.
bool outlines_fit_badly(const TrackerScene& scene, const std::deque<SceneEvidence>& window,
                        std::span<const FrameRecord> records);

void let_keypoints_lead(ObservationConfig& observation);

}  // namespace tracker
}  // namespace walktrack
