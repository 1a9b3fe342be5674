// The poses of two cameras that recorded the same walk, from the subject's keypoints alone.
//
// Both cameras stand still and see the same person, about at the same time; their lenses are
// approximately known. Every point that both see is on two rays, which have to meet. This
// determines the relative pose of the cameras up to its scale, their focal lengths and the lag
// between their clocks, by bundle adjustment (Triggs et al., "Bundle adjustment - a modern
// synthesis", 1999) with points at the nearest points of their rays, and with bones of constant
// length. The floor is level if the ankles of supporting legs have the same height, the trunk is
// upright and neither camera has much roll; the subject's stature gives the scale (with shares of
// it from Winter, "Biomechanics and motor control of human movement", 2009, figure 4.1).
//
// World: origin on the floor below the middle of the hips, averaged over all moments; x to the
// right in the first camera's image, z up. Metres, radians, seconds; pixel centres are at integers.
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
  double focal_px = 0, focal_sd = 0;  // the centre of the image is on the axis
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
  Measured apart;                    // distance between the cameras, m
  Measured angle;                    // between their axes, rad
  Measured lag;         // s: what the first camera shows at time t, the second shows at t + lag
  double residual = 0;  // rms distance between a point and its projection, share of the person's
                        // height in the image
  std::vector<Eigen::Vector3d> places;  // on the floor, world: below the hips, by moment
};

// InputError if both see fewer than 20 moments (about two seconds), or if for no pose of the
// cameras somebody could stand where both see them.
TwoViews two_views(std::span<const SeenMoment> first, std::span<const SeenMoment> second,
                   const TwoViewAssumptions& assumptions);

}  // namespace observation
}  // namespace walktrack
