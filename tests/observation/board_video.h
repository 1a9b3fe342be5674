// Images of calibration boards, exact for any lens: every pixel is the mean over rays.
#pragma once

#include <functional>
#include <vector>

#include <opencv2/core.hpp>

#include "camera/camera.h"
#include "observation/calibration/board.h"

namespace walktrack {

// A camera whose rays are computed once, for images of boards in front of it.
class BoardVideo {
 public:
  explicit BoardVideo(const Camera& lens);

  // The image of a board whose frame (observation/calibration/board.h) is given by
  // camera_from_board: a white sheet with a margin of one and a half spacings, in front of grey.
  cv::Mat picture(const Board& board, const Eigen::Matrix3d& rotation,
                  const Eigen::Vector3d& translation) const;

 private:
  Eigen::Vector2d ray(int u, int v, double across, double down) const;  // in pixel (u, v), 0 to 1

  int width_, height_;
  std::vector<Eigen::Vector2d> corners_;  // normalised, of the pixels' corners, row by row
};

// A pose of a board in view: its middle at `distance` along the ray of a pixel, rotated about its
// own axes by yaw, pitch (from facing the camera) and roll, rad.
struct BoardPose {
  Eigen::Matrix3d rotation;
  Eigen::Vector3d translation;
};
BoardPose board_pose(const Camera& lens, const Board& board, const Eigen::Vector2d& pixel,
                     double distance, double yaw, double pitch, double roll);

// Twelve poses that determine a lens: tilted to all sides, over the whole image.
std::vector<BoardPose> board_poses(const Camera& lens, const Board& board);

}  // namespace walktrack
