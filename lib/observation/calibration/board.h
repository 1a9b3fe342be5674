// Calibration boards in images: chessboards, and grids of dark circles on a light background with
// their rows below each other or, if asymmetric, every second row shifted by half a circle's
// distance.
//
// A board's points are its inner corners or circle centres, columns x rows of them, row by row:
// point (c, r) is at (c, r, 0) * spacing on the board, with x along a row, y along a column, and z,
// which makes the axes right-handed, into the board. Seen from the front, x to y turns clockwise.
// In an asymmetric grid point (c, r) is at (2 c + r mod 2, r, 0) * spacing.
//
// A board looks the same after half a turn, unless it is an asymmetric grid with an odd number of
// rows or a chessboard with columns + rows odd: then point (0, 0) is the corner whose inner square
// (towards the middle of the board) is dark.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

namespace cv {
class Mat;
}

namespace walktrack {
inline namespace observation {

enum class BoardKind { kChessboard, kCircles, kAsymmetricCircles };

struct Board {
  BoardKind kind = BoardKind::kChessboard;
  int columns = 9, rows = 6;  // of points
  double spacing = 0.025;     // m, between neighbouring points; of an asymmetric grid, rows
};

// Whether an image determines which end of the board is which.
bool has_one_origin(const Board& board);

// The points on the board, m, in the order of find_board.
std::vector<Eigen::Vector3d> board_points(const Board& board);

// The points in an 8-bit BGR image, px, to a fraction of a pixel; nullopt unless all are visible.
std::optional<std::vector<Eigen::Vector2d>> find_board(const cv::Mat& image, const Board& board);

}  // namespace observation
}  // namespace walktrack
