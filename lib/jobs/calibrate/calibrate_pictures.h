// The images of `walktrack calibrate`: points as they were found and as they are projected.
#pragma once

#include "io/calibration/measured_points.h"
#include "jobs/calibrate/calibrate_views.h"
#include "observation/calibration/camera_fit.h"
#include "observation/image.h"

namespace walktrack {
inline namespace jobs {

// Draws the points of all views over the image, with enlarged residuals.
Image lens_picture(const BoardViews& views, const LensFit& fit);

// Draws the given points, their projections, the ground grid and the axes.
Image place_picture(const Image& picture, const PlaceFit& fit, const MeasuredPoints& points);

}  // namespace jobs
}  // namespace walktrack
