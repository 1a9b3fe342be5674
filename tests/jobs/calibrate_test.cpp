// From images of boards, taken by known cameras, to the files.
#include "jobs/calibrate/calibrate.h"

#include <cmath>
#include <filesystem>
#include <span>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <opencv2/imgcodecs.hpp>

#include "core/conventions.h"
#include "core/errors.h"
#include "io/archive/files.h"
#include "io/calibration/calibration.h"
#include "io/calibration/formats/opencv.h"
#include "tests/camera/made_camera.h"
#include "tests/observation/board_video.h"
#include "tests/run_program.h"

namespace walktrack {
namespace {

namespace fs = std::filesystem;

using Eigen::Vector2d;
using Eigen::Vector3d;
using testing::HasSubstr;

constexpr Board kBoard{BoardKind::kChessboard, 8, 5, 0.04};

Camera small_lens(std::span<const double> coefficients, bool fisheye) {
  return lens({480, 360}, {400, 404}, {244, 176}, coefficients, fisheye);
}

Camera brown_lens() { return small_lens(std::array{-0.15, 0.03, 0.001, -0.001}, false); }

// 2.6 m from the origin, looking down at it.
Camera placed(const Camera& camera) { return looking_at(camera, {0.4, -2.4, 1.0}, {0.1, 0, 0}); }

// A board on the floor: x along its rows, z up.
cv::Mat floor_picture(const BoardVideo& video, const Camera& camera, const Board& board) {
  const Eigen::Matrix3d world_from_board = Eigen::AngleAxisd(kPi, Vector3d::UnitX()).matrix();
  return video.picture(board, camera.rotation * world_from_board, camera.translation);
}

class Calibrate : public testing::Test {
 protected:
  CalibrateJob views_job(const Camera& camera, const std::vector<BoardPose>& poses) {
    const BoardVideo video(camera);
    fs::create_directories(folder_.path() / "views");
    for (size_t i = 0; i < poses.size(); ++i)
      cv::imwrite(folder_ / fmt::format("views/{:02}.png", i),
                  video.picture(kBoard, poses[i].rotation, poses[i].translation));
    CalibrateJob job;
    job.board = kBoard;
    job.views = folder_ / "views";
    job.output = folder_ / "out";
    return job;
  }
  // Five points on the ground and one above it, seen by a camera in its place.
  CalibrateJob points_job(const std::function<void(Vector2d&, Vector3d&, int)>& change) {
    const Camera camera = placed(brown_lens());
    std::string csv = "u,v,x,y,z\n";
    int i = 0;
    for (Vector3d point : {Vector3d(-1, 0, 0),
                           {1, 0, 0},
                           {1, 1.5, 0},
                           {-1, 1.5, 0},
                           {0, 0.6, 0},
                           {0.5, -0.5, 0},
                           {-0.6, 0.9, 0}}) {
      Vector2d pixel = project(camera, point).value();
      change(pixel, point, i++);
      csv += fmt::format("{:.2f},{:.2f},{},{},{}\n", pixel.x(), pixel.y(), point.x(), point.y(),
                         point.z());
    }
    CalibrateJob job;
    job.camera = folder_.write("lens.yaml", opencv_from_camera(brown_lens()));
    job.points = folder_.write("points.csv", csv);
    job.output = folder_ / "out";
    return job;
  }
  static std::string error_of(const CalibrateJob& job) {
    try {
      calibrate(job, {});
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  TemporaryFolder folder_;
};

struct LensCase {
  const char* name;
  LensModel model;
  std::vector<double> coefficients;
};

// Corners have random errors of 0.1 px; over 12 views of 40 corners the error of a focal length is
// less than half a percent, and that of a ray near the border a pixel.
TEST_F(Calibrate, FindsTheLensThatTookTheViews) {
  for (const LensCase& each :
       {LensCase{"brown", LensModel::kBrown, {-0.15, 0.03, 0.001, -0.001}},
        LensCase{
            "rational", LensModel::kRational, {0.1, -0.05, 0.0005, 0.001, 0.01, 0.3, -0.02, 0}},
        LensCase{"fisheye", LensModel::kFisheye, {-0.02, 0.005, -0.002, 0.0005}}}) {
    const Camera camera = small_lens(each.coefficients, each.model == LensModel::kFisheye);
    CalibrateJob job = views_job(camera, board_poses(camera, kBoard));
    job.model = each.model;
    job.overwrite = true;
    const CalibrateOutcome outcome = calibrate(job, {});
    EXPECT_GE(outcome.views, 9u) << each.name;
    EXPECT_LT(*outcome.lens_rms_px, 0.2) << each.name;
    EXPECT_LT((outcome.camera.focal_px - camera.focal_px).norm(), 2) << each.name;
    for (const Vector3d& point : {Vector3d(0, 0, 1), Vector3d(0.4, 0.3, 1), Vector3d(-0.4, 0.2, 1)})
      EXPECT_LT((project_camera_point(outcome.camera, point).value() -
                 project_camera_point(camera, point).value())
                    .norm(),
                2)
          << each.name;
  }
}

TEST_F(Calibrate, FindsLensAndPlaceTogetherAndWritesWhatOtherProgramsRead) {
  const Camera camera = placed(brown_lens());
  CalibrateJob job = views_job(camera, board_poses(camera, kBoard));
  Board large = kBoard;  // the same board would be too small at 2.6 m
  large.spacing = 0.16;
  cv::imwrite(folder_ / "floor.png", floor_picture(BoardVideo(camera), camera, large));
  calibrate(job, {});
  CalibrateJob place;
  place.name = "cam0";
  place.board = large;
  place.camera = folder_ / "out/cam0.yaml";
  place.floor = folder_ / "floor.png";
  place.output = folder_ / "placed";
  const CalibrateOutcome outcome = calibrate(place, {});
  EXPECT_LT((camera_centre(outcome.camera) - camera_centre(camera)).norm(), 0.03);  // of 2.6 m
  EXPECT_THAT(outcome.notes, testing::IsEmpty());
  const Camera opencv = read_calibration(folder_ / "placed/cam0.yaml", "cam0");
  const Camera toml = read_calibration(folder_ / "placed/cam0.toml", "cam0");
  for (const Camera& read : {opencv, toml}) {
    const Vector3d point(0.3, 0.5, 0.2);
    EXPECT_LT((project(read, point).value() - project(outcome.camera, point).value()).norm(), 1e-6);
  }
  EXPECT_FALSE(cv::imread(folder_ / "out/cam0_lens.png").empty());
  EXPECT_FALSE(cv::imread(folder_ / "placed/cam0_place.png").empty());
  EXPECT_THAT(read_text_file(folder_ / "placed/cam0_residuals.csv", 1u << 20),
              testing::StartsWith("of,frame,point,u,v,miss_u,miss_v\nplace,0,0,"));
  EXPECT_THROW(calibrate(place, {}), UsageError);  // a complete result is not replaced
}

TEST_F(Calibrate, FindsThePlaceFromMeasuredPoints) {
  const auto as_they_are = [](Vector2d&, Vector3d&, int) {};
  const CalibrateOutcome outcome = calibrate(points_job(as_they_are), {});
  // Pixels are written to 0.005 px, a millimetre at 70 m.
  EXPECT_LT((camera_centre(outcome.camera) - Vector3d(0.4, -2.4, 1.0)).norm(), 0.001);
  EXPECT_LT(*outcome.place_rms_px, 0.01);
}

TEST_F(Calibrate, MirroredPointsAreNamedAsSuch) {
  const auto mirror = [](Vector2d&, Vector3d& point, int) { point.x() = -point.x(); };
  EXPECT_THAT(error_of(points_job(mirror)), HasSubstr("mirrored axes"));
  const auto exchange = [](Vector2d&, Vector3d& point, int) { std::swap(point.x(), point.y()); };
  EXPECT_THAT(error_of(points_job(exchange)), HasSubstr("mirrored axes"));
}

TEST_F(Calibrate, AWrongPointIsNamedByItsLine) {
  const auto slip = [](Vector2d& pixel, Vector3d&, int i) {
    if (i == 3) pixel.x() += 60;
  };
  EXPECT_THAT(error_of(points_job(slip)),
              testing::AllOf(HasSubstr("points.csv:5:"),
                             HasSubstr("a point that does not fit the others")));
}

TEST_F(Calibrate, PointsThatDetermineNothingAreRefused) {
  const auto on_a_line = [](Vector2d&, Vector3d& point, int) { point.y() = 0; };
  EXPECT_THAT(error_of(points_job(on_a_line)), HasSubstr("on one line"));
  CalibrateJob few = points_job([](Vector2d&, Vector3d&, int) {});
  few.points = folder_.write("few.csv", "u,v,x,y\n1,2,0,0\n10,2,1,0\n1,20,0,1\n");
  EXPECT_THAT(error_of(few), HasSubstr("3 points"));
}

TEST_F(Calibrate, ABoardOfAnotherSizeIsNamed) {
  const Camera camera = brown_lens();
  CalibrateJob job = views_job(camera, {board_poses(camera, kBoard)[4]});
  job.board->columns = 9;  // squares were counted, not corners
  job.board->rows = 6;
  EXPECT_THAT(error_of(job), testing::AllOf(HasSubstr("no chessboard of 9x6"),
                                            HasSubstr("but a chessboard of 8x5")));
}

TEST_F(Calibrate, TooFewOrEqualViewsAreRefused) {
  const Camera camera = brown_lens();
  std::vector<BoardPose> poses = board_poses(camera, kBoard);
  poses.resize(3);
  EXPECT_THAT(error_of(views_job(camera, poses)), HasSubstr("3 views of the board that differ"));
  // One view many times counts as one view.
  poses.assign(6, poses[0]);
  EXPECT_THAT(error_of(views_job(camera, poses)), HasSubstr("1 views of the board that differ"));
}

TEST_F(Calibrate, FacingViewsAreRefused) {
  const Camera camera = small_lens({}, false);
  std::vector<BoardPose> poses;
  for (const double u : {200.0, 240.0, 280.0})
    for (const double v : {160.0, 200.0})
      poses.push_back(board_pose(camera, kBoard, {u, v}, 1, 0, 0, 0));
  CalibrateJob job = views_job(camera, poses);
  job.model = LensModel::kPinhole;
  EXPECT_THAT(error_of(job), HasSubstr("do not tell the focal length"));
}

TEST_F(Calibrate, ABoardHalfOutOfViewIsRefusedWithAdvice) {
  const Camera camera = brown_lens();
  const auto half_out = board_pose(camera, kBoard, {475, 180}, 0.8, 0.1, 0.1, 0);
  EXPECT_THAT(error_of(views_job(camera, {half_out, half_out})),
              testing::AllOf(HasSubstr("no chessboard of 8x5"), HasSubstr("seen whole")));
}

TEST_F(Calibrate, AJobThatLacksSomethingSaysWhat) {
  CalibrateJob job;
  job.output = folder_ / "out";
  EXPECT_THROW(calibrate(job, {}), UsageError);
  job.views = folder_ / "views";
  EXPECT_THROW(calibrate(job, {}), UsageError);  // no board
  job.camera = folder_ / "cam.yaml";
  EXPECT_THROW(calibrate(job, {}), UsageError);  // two lenses
}

}  // namespace
}  // namespace walktrack
