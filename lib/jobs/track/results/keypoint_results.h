// Results about the keypoints that were used: their distances from the reported poses, how often
// their labels of the legs were swapped, and crosses where they are in the images.
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "body/body.h"
#include "io/config/config.h"
#include "io/drawing/overlay_view.h"
#include "io/scene/scene.h"
#include "jobs/track/results/track_results.h"
#include "observation/image.h"
#include "observation/keypoints/keypoint_term.h"

namespace walktrack {
inline namespace jobs {

// The median distance of a frame's points from a pose, px of the picture as recorded: of the person
// whom the pose fits best, with the labels as given; NaN if nobody was detected.
double keypoint_residual(const KeypointEvidence& seen, const Camera& camera, int shrink,
                         const Body& body, const Pose& pose);

// "keypoint_residual_px.side": such a list for each camera that has points in any frame.
std::vector<std::pair<std::string, std::vector<double>>> keypoint_residuals(
    const TrackedFrames& frames, const Scene& scene, const Config& config);

// All cameras together.
KeypointUse total_use(std::span<const KeypointTerm::State> cameras);

// For run.json: keypoint_frames (frames and cameras with people in them), keypoint_used_share (in
// which one was the subject), keypoint_flip_share (of those, with the legs' names swapped),
// keypoint_scale (what was learnt of a hip's, knee's or ankle's error: share of the person's
// height). Empty if no keypoints were used.
std::vector<std::pair<std::string, double>> keypoint_numbers(
    std::span<const KeypointTerm::State> cameras);

// Thin crosses where points were seen, of all people, in a view of the camera's picture; `seen` is
// of that picture shrunk by `shrink`.
void draw_keypoints(const KeypointEvidence& seen, int shrink, const OverlayView& view,
                    Image& image);

}  // namespace jobs
}  // namespace walktrack
