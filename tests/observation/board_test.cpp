#include "observation/calibration/board.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "core/conventions.h"
#include "tests/camera/made_camera.h"
#include "tests/observation/board_video.h"

namespace walktrack {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

Camera usual_lens() {
  return lens({480, 360}, {420, 425}, {243, 176}, std::array{-0.1, 0.02, 0.001, -0.001});
}

constexpr Board kChess{BoardKind::kChessboard, 7, 5, 0.04};  // one end differs
constexpr Board kCircles{BoardKind::kCircles, 7, 5, 0.04};   // both ends are alike
constexpr Board kShifted{BoardKind::kAsymmetricCircles, 4, 11, 0.03};
constexpr Board kUneven{BoardKind::kChessboard, 8, 5, 0.04};

// Largest distance between found points and projected points of the board, from the nearer end if
// both ends look alike; infinite if the board is not found.
double worst_miss(const Camera& camera, const BoardVideo& video, const Board& board,
                  const BoardPose& pose) {
  const auto found = find_board(video.picture(board, pose.rotation, pose.translation), board);
  if (!found) return std::numeric_limits<double>::infinity();
  Camera placed = camera;
  placed.rotation = pose.rotation;
  placed.translation = pose.translation;
  double worst = 0, worst_turned = 0;
  const std::vector<Vector3d> points = board_points(board);
  for (size_t i = 0; i < points.size(); ++i) {
    const Vector2d pixel = project(placed, points[i]).value();
    worst = std::max(worst, (pixel - found->at(i)).norm());
    worst_turned = std::max(worst_turned, (pixel - found->at(points.size() - 1 - i)).norm());
  }
  return has_one_origin(board) ? worst : std::min(worst, worst_turned);
}

// Squares are 15 to 20 px here; the error of the worst corner of a view is about three times the
// mean.
constexpr double kWorstCorner = 0.3;  // px

TEST(Board, CornersAreFoundToAFractionOfAPixelInTheirOrder) {
  const Camera camera = usual_lens();
  const BoardVideo video(camera);
  for (const BoardPose& pose : board_poses(camera, kUneven))
    EXPECT_LT(worst_miss(camera, video, kUneven, pose), kWorstCorner);
}

// The centre of a circle's image is not the image of its centre: for circles of 40 px and tilts of
// 35 degrees they are up to a quarter of a pixel apart.
TEST(Board, CirclesAreFoundToAThirdOfAPixelInTheirOrder) {
  const Camera camera = usual_lens();
  const BoardVideo video(camera);
  int found = 0;
  for (const BoardPose& pose : board_poses(camera, kCircles)) {
    const double miss = worst_miss(camera, video, kCircles, pose);
    if (std::isinf(miss)) continue;
    ++found;
    EXPECT_LT(miss, 0.35);
  }
  EXPECT_GE(found, 10);
}

// Rows are shifted in turn, so that the ends of an odd number of rows differ and the order is
// unique.
TEST(Board, ShiftedCirclesAreFoundInTheirOrderHoweverTheyLie) {
  const Camera camera = usual_lens();
  const BoardVideo video(camera);
  EXPECT_TRUE(has_one_origin(kShifted));
  EXPECT_FALSE(has_one_origin({BoardKind::kAsymmetricCircles, 4, 10, 0.03}));
  int found = 0;
  for (const BoardPose& pose : board_poses(camera, kShifted)) {
    const double miss = worst_miss(camera, video, kShifted, pose);
    if (std::isinf(miss)) continue;
    ++found;
    EXPECT_LT(miss, 0.35);
  }
  EXPECT_GE(found, 10);
  for (const double roll : {0.0, 0.5 * kPi, kPi, 1.5 * kPi}) {
    const BoardPose pose = board_pose(camera, kShifted, {240, 180}, 0.9, 0.2, 0.3, roll);
    EXPECT_LT(worst_miss(camera, video, kShifted, pose), 0.35) << "turned by " << roll;
  }
}

TEST(Board, AnUnevenChessboardKeepsItsOriginHoweverItLies) {
  const Camera camera = usual_lens();
  const BoardVideo video(camera);
  EXPECT_TRUE(has_one_origin(kUneven));
  EXPECT_FALSE(has_one_origin(kChess));
  EXPECT_FALSE(has_one_origin(kCircles));
  for (const double roll : {0.0, 0.5 * kPi, kPi, 1.5 * kPi, 2.0}) {
    const BoardPose pose = board_pose(camera, kUneven, {240, 180}, 0.9, 0.2, 0.3, roll);
    EXPECT_LT(worst_miss(camera, video, kUneven, pose), kWorstCorner) << "turned by " << roll;
  }
}

TEST(Board, ABoardThatIsCutIsNotFound) {
  const Camera camera = usual_lens();
  const BoardVideo video(camera);
  for (const Board& board : {kUneven, kCircles}) {
    const BoardPose whole = board_pose(camera, board, {240, 180}, 0.9, 0.2, 0.2, 0);
    EXPECT_LT(worst_miss(camera, video, board, whole), 0.35);
    const BoardPose half = board_pose(camera, board, {475, 180}, 0.9, 0.2, 0.2, 0);
    EXPECT_TRUE(std::isinf(worst_miss(camera, video, board, half)));
  }
}

TEST(Board, AnotherSizeIsNotFoundNorOneInAnEmptyPicture) {
  const Camera camera = usual_lens();
  const BoardVideo video(camera);
  const BoardPose pose = board_pose(camera, kUneven, {240, 180}, 0.9, 0.2, 0.2, 0);
  Board other = kUneven;
  other.columns = 9;
  EXPECT_FALSE(find_board(video.picture(kUneven, pose.rotation, pose.translation), other));
  const cv::Mat empty(360, 480, CV_8UC3, cv::Scalar(120, 120, 120));
  EXPECT_FALSE(find_board(empty, kUneven));
  EXPECT_FALSE(find_board(empty, kCircles));
}

}  // namespace
}  // namespace walktrack
