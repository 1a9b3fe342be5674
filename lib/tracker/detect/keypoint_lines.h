// Where somebody walks by their keypoints alone: lines over the ground that the search may begin
// with; it is the likelihood that judges them.
//
// Of every person in every picture the place on the ground is that at which an upright figure of
// the subject's height has its shoulders, hips and ankles where they were seen (least squares over
// the place's two coordinates): the floor says how far, and the height says it again. People are
// followed from frame to frame by the nearest place, and each track's line is the median of the
// lines through its pairs of places (Theil 1950, Sen 1968), which a few strays do not move.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "observation/keypoints/keypoint_term.h"

namespace walktrack {
inline namespace tracker {

// Ground position, m, of a person of that height; nullopt where too little of them was seen, or
// where no place explains it. `camera` is that of the image that the points are of.
std::optional<Eigen::Vector2d> place_of(const KeypointEvidence::Person& person,
                                        const Camera& camera, double height);

struct KeypointLine {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  // at time 0, m
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  // m/s
  int frames = 0;                                      // in which the person was seen
};

// The lines of one camera's people, most frames first: `frames` are `dt` s apart, the first at time
// 0. Only of people who were seen for at least `least_seconds` from first to last.
std::vector<KeypointLine> keypoint_lines(std::span<const KeypointEvidence* const> frames,
                                         const Camera& camera, double height, double dt,
                                         double least_seconds);

}  // namespace tracker
}  // namespace walktrack
