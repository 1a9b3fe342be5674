// Where a camera stands, from somebody of known stature who walks through its picture.
//
// The camera is nearly level and its lens is about known. With its height h above the floor, its
// tilt (down), its roll and its focal length, the pixel of the feet says where on the floor
// somebody stands, and that where their head appears. Positions near and far tell h and the tilt
// apart (Criminisi, Reid & Zisserman, "Single view metrology", IJCV 2000); of a walk straight
// across the picture all are equally far, and then the tilt is what was assumed, with its spread.
// Known lengths on the floor, the sides of a tile, say what the walk leaves open.
//
// World axes of the camera: origin on the floor below the middle position, x to the right of the
// picture, y away from the camera, z up. Metres, radians; pixels have their centres at integers.
#pragma once

#include <span>
#include <vector>

#include "camera/camera.h"

namespace walktrack {
inline namespace camera {

// Somebody at one place: means over a stride, for a head goes up and down.
struct SeenStature {
  double u_px, top_px, bottom_px;  // the column, the row of the top of the head, that of the floor
};

// Two points on the floor, px, and how far they are apart, m.
struct FloorLength {
  Eigen::Vector2d from_px, to_px;
  double metres;
};

struct ViewAssumptions {
  int width_px = 0, height_px = 0;
  double focal_px = 0, focal_sd = 0;   // px; the centre of the picture is on the axis
  double stature = 0, stature_sd = 0;  // from floor to top in the picture, m
  double tilt = 0, tilt_sd = 0;        // down, before anything is seen
  double roll_sd = 0;                  // about zero
  double row_sd = 0.01;                // of a top or bottom, share of the person's height
  std::vector<FloorLength> floor{};    // none: fine
  double point_sd_px = 1.5;            // of a point on the floor, as people mark it
};

// A number and its standard deviation.
struct Measured {
  double value = 0, sd = 0;
};

struct WalkerView {
  Camera camera;
  Measured focal_px;
  Measured height;         // above the floor, m
  Measured tilt, roll;     // rad
  Measured distance;       // of the middle position from the camera, along the floor, m
  Measured metres_per_px;  // there
  double residual = 0;     // rms of the rows, share of the person's height
  double floor_rms = 0;    // of the lengths on the floor, m
};

// At least one position, all of finite rows with bottom_px > top_px + 1. InputError where the feet
// are above the horizon for every tilt that is likely, or a point of the floor is there.
WalkerView view_from_walker(std::span<const SeenStature> positions,
                            const ViewAssumptions& assumptions);

}  // namespace camera
}  // namespace walktrack
