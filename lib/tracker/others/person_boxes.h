// Whose pixels are whose, of people who stand near one another: by boxes around them in the
// pictures. A pixel in the boxes of two people belongs to the one whose middle is nearer, in units
// of the box; but somebody who is clearly nearer to the camera hides who is behind, and all pixels
// in their box are theirs.
#pragma once

#include <span>

#include <Eigen/Core>

#include "tracker/subject_model.h"

namespace walktrack {
inline namespace tracker {

// The box around somebody of the subject's height at a place on the ground, with a margin of
// `margin` metres to all sides; empty if they are behind the camera.
PixelRect person_box(const TrackContext& context, size_t camera, const Eigen::Vector2d& place,
                     double margin);

// Whether two people are in front of one another in every picture that both are in.
bool behind_one_another(const TrackContext& context, const Eigen::Vector2d& one,
                        const Eigen::Vector2d& other);

// What the outlines are evidence of: the planes and the weights of their pixels.
SceneEvidence outlines_of(const SceneEvidence& evidence);

// From then on pixels that belong to any of `others` rather than to a person at `place` contain
// no evidence.
void hide_others(const TrackContext& context, std::span<const Eigen::Vector2d> others,
                 const Eigen::Vector2d& place, SceneEvidence& evidence);

// From then on the pixels in boxes around `people` with that margin, m, contain no evidence.
void hide_people(const TrackContext& context, std::span<const Eigen::Vector2d> people,
                 double margin, SceneEvidence& evidence);

}  // namespace tracker
}  // namespace walktrack
