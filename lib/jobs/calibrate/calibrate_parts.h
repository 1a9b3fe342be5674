// The parts of `walktrack calibrate`.
#pragma once

#include <vector>

#include <opencv2/core/mat.hpp>

#include "io/calibration/measured_points.h"
#include "jobs/calibrate/calibrate.h"

namespace walktrack {
inline namespace jobs {

// Views of the board that differ from each other.
struct BoardViews {
  int width_px = 0, height_px = 0;
  std::vector<int> frames;
  std::vector<PixelPoints> points;
  cv::Mat picture;  // the first of them
};

inline constexpr size_t kFewestViews = 4;
inline constexpr size_t kMostViews = 40;

// InputError with the cure if there are fewer than kFewestViews of them.
BoardViews collect_views(const std::filesystem::path& source, const Board& board,
                         const JobControl& control);

// The board in a frame of the source: one that lies still. InputError if there is none.
BoardViews find_floor_board(const std::filesystem::path& source, const Board& board);

// The camera's place from points, checked: InputError for mirrored axes, a camera underground and
// points that do not fit, naming the worst. `file` and `lines` are what messages call the points.
PlaceFit checked_place(const Camera& lens, const MeasuredPoints& points, const std::string& file);

// All views' points over the picture, each with its miss enlarged.
cv::Mat lens_picture(const BoardViews& views, const LensFit& fit);

// The given points, their projections, the ground grid and the axes.
cv::Mat place_picture(const cv::Mat& picture, const PlaceFit& fit, const MeasuredPoints& points);

}  // namespace jobs
}  // namespace walktrack
