#include "io/drawing/overlay.h"

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "body/motion.h"
#include "tests/camera/sample_cameras.h"

namespace walktrack {
namespace {

using Eigen::Vector3d;

cv::Mat black() { return cv::Mat(480, 640, CV_8UC3, cv::Scalar::all(0)); }

cv::Vec3b at(const cv::Mat& image, const Camera& camera, const Vector3d& point) {
  const auto pixel = project(camera, point);
  return image.at<cv::Vec3b>(static_cast<int>(std::lround(pixel->y())),
                             static_cast<int>(std::lround(pixel->x())));
}

bool is_black(const cv::Mat& image) { return cv::norm(image, cv::NORM_INF) == 0; }

// Points along a line in the world are painted, for any lens.
TEST(DrawLine, FollowsTheLens) {
  const Vector3d from(-1, 0, 0.2), to(1, 0.5, 1.6);
  for (const SampleCamera& lens : sample_lenses()) {
    const Camera camera = sample_camera(lens);
    cv::Mat image = black();
    draw_line(image, camera, from, to, {0, 0, 255}, 3);
    for (double share = 0.02; share < 1; share += 0.05) {
      EXPECT_GT(at(image, camera, from + share * (to - from))[2], 100) << lens.name;
    }
  }
}

TEST(DrawLine, LeavesOutWhatIsBehindOrFarOutside) {
  const Camera camera = sample_camera({"pinhole", {}});
  cv::Mat image = black();
  draw_line(image, camera, {1, -20, 3}, {1, -10, 3}, {0, 0, 255}, 3);  // behind the camera
  draw_line(image, camera, {1e6, 0, 0}, {1e7, 0, 1}, {0, 0, 255}, 3);
  draw_line(image, camera, Vector3d::Constant(NAN), {0, 0, 1}, {0, 0, 255}, 3);
  EXPECT_TRUE(is_black(image));
}

JointPositions standing() {
  JointPositions joints = unknown_joints();
  joints[Joint::kPelvis] = {0, 0, 0.95};
  joints[Joint::kNeck] = {0, 0, 1.5};
  joints[Joint::kHead] = {0, 0, 1.65};
  joints[Joint::kLeftHip] = {-0.3, 0, 0.95};
  joints[Joint::kLeftKnee] = {-0.3, 0, 0.5};
  joints[Joint::kRightHip] = {0.3, 0, 0.95};
  joints[Joint::kRightKnee] = {0.3, 0, 0.5};
  joints[Joint::kRightAnkle] = {0.3, 0, 0.1};
  return joints;
}

TEST(DrawSkeleton, ColoursSidesAndPassesOverUnknownJoints) {
  const Camera camera = sample_camera({"pinhole", {}});
  cv::Mat image = black();
  draw_skeleton(image, camera, standing(), true, 3);
  const cv::Vec3b left = at(image, camera, {-0.3, 0, 0.7}),
                  right = at(image, camera, {0.3, 0, 0.7});
  EXPECT_GT(left[0], left[2]);
  EXPECT_GT(right[2], right[0]);
  EXPECT_EQ(at(image, camera, {-0.3, 0, 0.3}), cv::Vec3b(0, 0, 0));  // the left ankle is unknown
}

TEST(DrawSpread, BlendsAndLeavesTheRestAlone) {
  const Camera camera = sample_camera({"pinhole", {}});
  cv::Mat image(480, 640, CV_8UC3, cv::Scalar::all(100));
  const cv::Mat before = image.clone();
  const std::vector<JointPositions> skeletons(3, standing());
  draw_spread(image, camera, skeletons, false, 0.5);
  EXPECT_EQ(image.at<cv::Vec3b>(5, 5), before.at<cv::Vec3b>(5, 5));
  const auto trunk = at(image, camera, {0, 0, 1.2});
  EXPECT_GT(trunk[1], 100);
  EXPECT_LT(trunk[1], 255);
  draw_spread(image, camera, {}, false, 0.5);
}

TEST(Drawing, GridAxesAndCaptionPaintSomething) {
  const Camera camera = sample_camera({"brown", {-0.2, 0.05, 0, 0, 0}});
  cv::Mat image = black();
  draw_ground_grid(image, camera, {0, 0}, 2);
  EXPECT_GT(at(image, camera, {1, 0.37, 0})[1], 50);
  image = black();
  draw_axes(image, camera, {0, 0, 0}, 1);
  EXPECT_GT(at(image, camera, {0.5, 0, 0})[2], 150);
  EXPECT_GT(at(image, camera, {0, 0, 0.5})[0], 150);
  image = black();
  draw_caption(image, "frame 3");
  EXPECT_FALSE(is_black(image));
}

}  // namespace
}  // namespace walktrack
