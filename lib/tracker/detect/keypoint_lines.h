// Lines over the ground along which people walk, from keypoints alone. The search may begin with
// these lines; the likelihood decides which of them are right.
//
// The place of a person in an image is the ground point at which the shoulders, hips and ankles of
// an upright figure of the subject's height fit the detected points (least squares over the two
// coordinates of the place): both the floor and the height determine the distance. People are
// followed from frame to frame by the nearest place, and the line of each track is the median of
// the lines through its pairs of places (Theil 1950, Sen 1968), which a few outliers do not move.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "observation/keypoints/keypoint_term.h"

namespace walktrack {
inline namespace tracker {

// Ground position, m, of a person of that height; nullopt if too few of their points were seen, or
// if no place explains the points. `camera` is the camera of the image in which the points lie.
std::optional<Eigen::Vector2d> place_of(const KeypointEvidence::Person& person,
                                        const Camera& camera, double height);

struct KeypointLine {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  // at time 0, m
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  // m/s
  int frames = 0;                                      // in which the person was seen
};

// The lines of the people in one camera, those with most frames first: `frames` are `dt` s apart,
// the first one at time 0. Only people who were seen over at least `least_seconds` have a line.
std::vector<KeypointLine> keypoint_lines(std::span<const KeypointEvidence* const> frames,
                                         const Camera& camera, double height, double dt,
                                         double least_seconds);

}  // namespace tracker
}  // namespace walktrack
