// The poses of two cameras that recorded the same walk, from the subject's keypoints alone.
//
// Both cameras stand still and see the same person, about at the same time; their lenses are about
// known. Every point that both see lies on two rays, which have to meet. This determines the pose
// of the cameras relative to each other up to its scale, their focal lengths and the lag between
// their clocks, by bundle adjustment (Triggs et al., "Bundle adjustment - a modern synthesis",
// 1999) in which points are where their rays are nearest, and bones do not change their length. The
// floor is level where stance ankles stay as high, the trunk is upright and neither camera is
// turned much; the subject's stature gives the scale (shares of it: Winter, "Biomechanics and motor
// control of human movement", 2009, figure 4.1).
//
// World: origin on the floor below the middle of the hips, mean of all moments; x to the right of
// the first camera's picture, z up. Metres, radians, seconds; pixels have their centres at
// integers.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "camera/view_from_walker.h"
#include "observation/keypoints/keypoints.h"

namespace walktrack {
inline namespace observation {

// One person at one time of a video.
struct SeenMoment {
  double time;  // s, increasing
  DetectedPerson person;
};

struct LensAssumption {
  int width_px = 0, height_px = 0;
  double focal_px = 0, focal_sd = 0;  // the centre of the picture is on the axis
};

struct TwoViewAssumptions {
  std::array<LensAssumption, 2> lenses;
  double stature = 0, stature_sd = 0;  // m
};

struct TwoViews {
  std::array<Camera, 2> cameras;
  std::array<Measured, 2> focal_px;
  std::array<Measured, 2> height;    // above the floor, m
  std::array<Measured, 2> tilt;      // down, rad
  std::array<Measured, 2> distance;  // of the world's origin from the camera, along the floor, m
  Measured apart;                    // the cameras, m
  Measured angle;                    // between their axes, rad
  Measured lag;         // s: what the first shows at some time, the second shows at that time + lag
  double residual = 0;  // rms of where a point is seen from where both rays put it, share of the
                        // person's height in the picture
  std::vector<Eigen::Vector3d> places;  // on the floor, world: below the hips, by moment
};

// InputError where fewer than 20 moments (about two seconds) are seen by both, or nobody could
// stand where both see them, whatever the cameras' pose.
TwoViews two_views(std::span<const SeenMoment> first, std::span<const SeenMoment> second,
                   const TwoViewAssumptions& assumptions);

}  // namespace observation
}  // namespace walktrack
