#include "tests/observation/board_video.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <Eigen/Geometry>

namespace walktrack {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

constexpr int kRaysAcross = 4;
constexpr double kTable = 120, kPaper = 235, kInk = 25;

// Coordinates of the last point, in spacings.
Vector2d extent(const Board& board) {
  const int columns =
      board.kind == BoardKind::kAsymmetricCircles ? 2 * board.columns : board.columns;
  return {columns - 1, board.rows - 1};
}

// Asymmetric grids: whether a circle's centre is near. Tests the rows around p, and in each the
// nearest column.
bool in_shifted_circle(const Board& board, const Vector2d& p) {
  for (const double near : {std::floor(p.y()), std::ceil(p.y())}) {
    const int row = std::clamp(static_cast<int>(near), 0, board.rows - 1);
    const double column = std::clamp(std::round((p.x() - row % 2) / 2), 0.0, board.columns - 1.0);
    if ((p - Vector2d(2 * column + row % 2, row)).norm() < 0.4) return true;
  }
  return false;
}

double shade(const Board& board, const Vector2d& at) {
  const Vector2d p = at / board.spacing;
  const Vector2d last = extent(board);
  const double margin = board.kind == BoardKind::kChessboard ? 2.0 : 1.5;
  if ((p.array() < -margin).any() || ((p - last).array() > margin).any()) return kTable;
  if (board.kind == BoardKind::kAsymmetricCircles)
    return in_shifted_circle(board, p) ? kInk : kPaper;
  if (board.kind == BoardKind::kCircles) {
    const Vector2d nearest = p.array().round().max(0).min(last.array());
    return (p - nearest).norm() < 0.3 ? kInk : kPaper;
  }
  if ((p.array() < -1).any() || ((p - last).array() > 1).any()) return kPaper;
  const int parity = static_cast<int>(std::floor(p.x()) + std::floor(p.y()));
  return parity % 2 == 0 ? kInk : kPaper;  // the square inside the first point is dark
}

}  // namespace

BoardVideo::BoardVideo(const Camera& lens) : width_(lens.width_px), height_(lens.height_px) {
  for (int v = 0; v <= height_; ++v) {
    for (int u = 0; u <= width_; ++u) {
      const Vector2d corner(u - 0.5, v - 0.5);
      corners_.push_back(
          undistort(lens, (corner - lens.centre_px).cwiseQuotient(lens.focal_px)).value());
    }
  }
}

// Bilinear between the rays of a pixel's corners; the lens bends less than 1e-3 px from it.
Vector2d BoardVideo::ray(int u, int v, double across, double down) const {
  const size_t row = static_cast<size_t>(width_ + 1);
  const Vector2d* at = &corners_[static_cast<size_t>(v) * row + static_cast<size_t>(u)];
  return (1 - down) * ((1 - across) * at[0] + across * at[1]) +
         down * ((1 - across) * at[row] + across * at[row + 1]);
}

cv::Mat BoardVideo::picture(const Board& board, const Matrix3d& rotation,
                            const Vector3d& translation) const {
  // A ray d meets the board z = 0 where R' (s d - t) has no third component.
  const Vector3d normal = rotation.col(2);
  const double distance = normal.dot(translation);
  const auto on_board = [&](const Vector2d& flat) -> std::optional<Vector2d> {
    const Vector3d d = flat.homogeneous();
    const double along = distance / normal.dot(d);
    if (!(along > 0)) return std::nullopt;
    return (rotation.transpose() * (along * d - translation)).head<2>();
  };
  const Vector2d middle = 0.5 * board.spacing * extent(board);
  const double reach = middle.norm() + 4 * board.spacing;  // beyond the sheet
  cv::Mat out(height_, width_, CV_8UC3);
  for (int v = 0; v < height_; ++v) {
    for (int u = 0; u < width_; ++u) {
      const auto centre = on_board(ray(u, v, 0.5, 0.5));
      double sum = kRaysAcross * kRaysAcross * kTable;
      if (centre && (*centre - middle).norm() < reach) {
        sum = 0;
        for (int i = 0; i < kRaysAcross * kRaysAcross; ++i)
          sum += shade(board, on_board(ray(u, v, (i % kRaysAcross + 0.5) / kRaysAcross,
                                           (i / kRaysAcross + 0.5) / kRaysAcross))
                                  .value());
      }
      out.at<cv::Vec3b>(v, u) =
          cv::Vec3b::all(static_cast<uchar>(std::lround(sum / (kRaysAcross * kRaysAcross))));
    }
  }
  return out;
}

BoardPose board_pose(const Camera& lens, const Board& board, const Vector2d& pixel, double distance,
                     double yaw, double pitch, double roll) {
  const auto flat = undistort(lens, (pixel - lens.centre_px).cwiseQuotient(lens.focal_px));
  const Vector3d middle = distance * flat.value().homogeneous();
  const Matrix3d turn =
      (Eigen::AngleAxisd(yaw, Vector3d::UnitY()) * Eigen::AngleAxisd(pitch, Vector3d::UnitX()) *
       Eigen::AngleAxisd(roll, Vector3d::UnitZ()))
          .toRotationMatrix();
  const Vector2d half = 0.5 * board.spacing * extent(board);
  return {turn, middle - turn * Vector3d(half.x(), half.y(), 0)};
}

std::vector<BoardPose> board_poses(const Camera& lens, const Board& board) {
  const double size = board.spacing * (extent(board).maxCoeff() + 1);
  // At such a distance that the board covers a third of the image.
  const double distance = 3 * size * lens.focal_px.x() / lens.width_px;
  std::vector<BoardPose> out;
  for (int i = 0; i < 12; ++i) {
    const double across = 0.5 + 0.24 * (i % 3 - 1), down = 0.5 + 0.2 * (i / 3 % 3 - 1);
    const Vector2d pixel(across * lens.width_px, down * lens.height_px);
    const double angle = 2.4 * i;  // about the golden angle: every tilt is different
    out.push_back(board_pose(lens, board, pixel, distance * (1 + 0.1 * (i % 4 - 1)),
                             0.6 * std::cos(angle), 0.6 * std::sin(angle),
                             0.3 * std::sin(5.0 * i)));
  }
  return out;
}

}  // namespace walktrack
