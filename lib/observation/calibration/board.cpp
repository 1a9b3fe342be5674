#include "observation/calibration/board.h"

#include <algorithm>
#include <cmath>

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

namespace walktrack {
inline namespace observation {

namespace {

using Points = std::vector<cv::Point2f>;

size_t at(const Board& board, int column, int row) {
  return static_cast<size_t>(row) * static_cast<size_t>(board.columns) +
         static_cast<size_t>(column);
}

double distance(const cv::Point2f& a, const cv::Point2f& b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

// The smallest distance between neighbours in a row or column, px.
double least_spacing(const Board& board, const Points& points) {
  double least = 1e9;
  for (int r = 0; r < board.rows; ++r) {
    for (int c = 0; c < board.columns; ++c) {
      const cv::Point2f& point = points[at(board, c, r)];
      if (c > 0) least = std::min(least, distance(point, points[at(board, c - 1, r)]));
      if (r > 0) least = std::min(least, distance(point, points[at(board, c, r - 1)]));
    }
  }
  return least;
}

// Reverses the rows if x to y would turn counter-clockwise.
void make_clockwise(const Board& board, Points& points) {
  const cv::Point2f origin = points.front();
  const cv::Point2f x = points[at(board, board.columns - 1, 0)] - origin;
  const cv::Point2f y = points[at(board, 0, board.rows - 1)] - origin;
  if (x.cross(y) > 0) return;
  for (int r = 0; r < board.rows; ++r) {
    const auto row = points.begin() + static_cast<std::ptrdiff_t>(at(board, 0, r));
    std::reverse(row, row + board.columns);
  }
}

// Mean brightness in the middle of the square between points (c, r) and (c + 1, r + 1).
double square_brightness(const cv::Mat& grey, const Board& board, const Points& points, int c,
                         int r) {
  const cv::Point2f middle =
      0.25f * (points[at(board, c, r)] + points[at(board, c + 1, r)] + points[at(board, c, r + 1)] +
               points[at(board, c + 1, r + 1)]);
  cv::Mat patch;
  cv::getRectSubPix(grey, {3, 3}, middle, patch);
  return cv::mean(patch)[0];
}

// Reverses the order if it does not begin at the corner whose inner square is dark and the two ends
// differ.
void make_dark_first(const cv::Mat& grey, const Board& board, Points& points) {
  if (!has_one_origin(board)) return;
  const double first = square_brightness(grey, board, points, 0, 0);
  const double last = square_brightness(grey, board, points, board.columns - 2, board.rows - 2);
  if (first > last) std::reverse(points.begin(), points.end());
}

std::optional<Points> find_chessboard(const cv::Mat& grey, const Board& board) {
  Points points;
  const int flags =
      cv::CALIB_CB_ADAPTIVE_THRESH | cv::CALIB_CB_NORMALIZE_IMAGE | cv::CALIB_CB_FAST_CHECK;
  if (!cv::findChessboardCorners(grey, {board.columns, board.rows}, points, flags))
    return std::nullopt;
  // The window must not reach the next corner.
  const int half = std::clamp(static_cast<int>(0.45 * least_spacing(board, points)), 2, 11);
  const cv::TermCriteria until(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 40, 1e-3);
  cv::cornerSubPix(grey, points, {half, half}, {-1, -1}, until);
  make_clockwise(board, points);
  make_dark_first(grey, board, points);
  return points;
}

// Centroids of dark regions that are nearly elliptic.
Points dark_blobs(const cv::Mat& grey) {
  // By hand.
  constexpr double kLeastArea = 12;          // px
  constexpr double kLeastEllipticity = 0.9;  // area over that of the ellipse with the same moments
  cv::Mat dark;
  const int window = std::max(15, grey.cols / 12) | 1;
  cv::adaptiveThreshold(grey, dark, 255, cv::ADAPTIVE_THRESH_MEAN_C, cv::THRESH_BINARY_INV, window,
                        10);
  std::vector<std::vector<cv::Point>> outlines;
  cv::findContours(dark, outlines, cv::RETR_LIST, cv::CHAIN_APPROX_NONE);
  Points centres;
  for (const std::vector<cv::Point>& outline : outlines) {
    const cv::Moments m = cv::moments(outline);
    if (m.m00 < kLeastArea) continue;
    // An ellipse with semi-axes a, b has det(second moments) = (a b / 4)^2 per area.
    const double xx = m.mu20 / m.m00, yy = m.mu02 / m.m00, xy = m.mu11 / m.m00;
    const double of_ellipse = 4 * CV_PI * std::sqrt(std::max(xx * yy - xy * xy, 0.0));
    if (m.m00 < kLeastEllipticity * of_ellipse) continue;
    centres.emplace_back(static_cast<float>(m.m10 / m.m00), static_cast<float>(m.m01 / m.m00));
  }
  return centres;
}

std::optional<Points> find_circles(const cv::Mat& grey, const Board& board) {
  const Points blobs = dark_blobs(grey);
  const size_t wanted = at(board, 0, board.rows);
  constexpr size_t kMostBlobs = 4000;  // the search is quadratic
  if (blobs.size() < wanted || blobs.size() > kMostBlobs) return std::nullopt;
  Points points;
  const cv::Ptr<cv::FeatureDetector> candidates_are_given;
  const bool asymmetric = board.kind == BoardKind::kAsymmetricCircles;
  const int flags = asymmetric ? cv::CALIB_CB_ASYMMETRIC_GRID : cv::CALIB_CB_SYMMETRIC_GRID;
  if (!cv::findCirclesGrid(blobs, {board.columns, board.rows}, points, flags, candidates_are_given))
    return std::nullopt;
  if (!asymmetric) make_clockwise(board, points);
  return points;
}

}  // namespace

bool has_one_origin(const Board& board) {
  if (board.kind == BoardKind::kAsymmetricCircles) return board.rows % 2 == 1;
  return board.kind == BoardKind::kChessboard && (board.columns + board.rows) % 2 == 1;
}

std::vector<Eigen::Vector3d> board_points(const Board& board) {
  const bool asymmetric = board.kind == BoardKind::kAsymmetricCircles;
  std::vector<Eigen::Vector3d> out;
  for (int r = 0; r < board.rows; ++r)
    for (int c = 0; c < board.columns; ++c)
      out.emplace_back((asymmetric ? 2 * c + r % 2 : c) * board.spacing, r * board.spacing, 0);
  return out;
}

std::optional<std::vector<Eigen::Vector2d>> find_board(const cv::Mat& image, const Board& board) {
  cv::Mat grey;
  cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);
  const auto found = board.kind == BoardKind::kChessboard ? find_chessboard(grey, board)
                                                          : find_circles(grey, board);
  if (!found) return std::nullopt;
  std::vector<Eigen::Vector2d> out;
  for (const cv::Point2f& point : *found) out.emplace_back(point.x, point.y);
  return out;
}

}  // namespace observation
}  // namespace walktrack
