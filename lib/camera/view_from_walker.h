// The pose of a camera from a subject of known stature who walks through its image.
//
// The camera is nearly level and its lens is approximately known. From its height h above the
// floor, its tilt (down), its roll and its focal length, the pixel of the feet determines the
// position of the person on the floor, and this the position of the head in the image. Positions at
// different distances distinguish h from the tilt (Criminisi, Reid & Zisserman, "Single view
// metrology", IJCV 2000); in a walk straight across the image all distances are equal, and the tilt
// keeps its assumed value and spread. Known lengths on the floor, such as the sides of a tile,
// determine what the walk does not.
//
// World axes of the camera: origin on the floor below the middle position, x to the right in the
// image, y away from the camera, z up. Metres, radians; pixel centres are at integers.
#pragma once

#include <span>
#include <vector>

#include "camera/camera.h"

namespace walktrack {
inline namespace camera {

// A person at one position: means over a stride, because the head moves up and down.
struct SeenStature {
  double u_px, top_px, bottom_px;  // the column, the rows of the top of the head and of the floor
};

// Two points on the floor, px, and their distance, m.
struct FloorLength {
  Eigen::Vector2d from_px, to_px;
  double metres;
};

struct ViewAssumptions {
  int width_px = 0, height_px = 0;
  double focal_px = 0, focal_sd = 0;   // px; the centre of the image is on the axis
  double stature = 0, stature_sd = 0;  // from floor to top in the image, m
  double tilt = 0, tilt_sd = 0;        // down, assumed
  double roll_sd = 0;                  // about zero
  double row_sd = 0.01;                // of the top or bottom row, share of the person's height
  std::vector<FloorLength> floor{};    // may be empty
  double point_sd_px = 1.5;            // of a point on the floor that was marked by hand
};

// A number with its standard deviation.
struct Measured {
  double value = 0, sd = 0;
};

struct WalkerView {
  Camera camera;
  Measured focal_px;
  Measured height;         // above the floor, m
  Measured tilt, roll;     // rad
  Measured distance;       // from the camera to the middle position along the floor, m
  Measured metres_per_px;  // there
  double residual = 0;     // rms of the rows, share of the person's height
  double floor_rms = 0;    // of the lengths on the floor, m
};

// At least one position, all with finite rows and bottom_px > top_px + 1. InputError if the feet,
// or a point of the floor, are above the horizon for every likely tilt.
WalkerView view_from_walker(std::span<const SeenStature> positions,
                            const ViewAssumptions& assumptions);

}  // namespace camera
}  // namespace walktrack
