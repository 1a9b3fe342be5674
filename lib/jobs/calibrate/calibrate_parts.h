// The parts of `walktrack calibrate`.
#pragma once

#include <vector>

#include "io/calibration/measured_points.h"
#include "jobs/calibrate/calibrate.h"
#include "observation/image.h"

namespace walktrack {
inline namespace jobs {

// Views of the board that differ from each other.
struct BoardViews {
  int width_px = 0, height_px = 0;
  std::vector<int> frames;
  std::vector<PixelPoints> points;
  Image picture;  // the first of them
};

inline constexpr size_t kFewestViews = 4;
inline constexpr size_t kMostViews = 40;

// Throws an InputError with advice if there are fewer than kFewestViews of them.
BoardViews collect_views(const std::filesystem::path& source, const Board& board,
                         const JobControl& control);

// Finds the board in a frame of a source in which it does not move. InputError if there is none.
BoardViews find_floor_board(const std::filesystem::path& source, const Board& board);

// The camera's pose from points. Throws an InputError for mirrored axes, a camera below the ground,
// and points that do not fit, naming the worst one. `file` and `lines` name the points in messages.
PlaceFit checked_place(const Camera& lens, const MeasuredPoints& points, const std::string& file);

// Draws the points of all views over the image, with enlarged residuals.
Image lens_picture(const BoardViews& views, const LensFit& fit);

// Draws the given points, their projections, the ground grid and the axes.
Image place_picture(const Image& picture, const PlaceFit& fit, const MeasuredPoints& points);

}  // namespace jobs
}  // namespace walktrack
