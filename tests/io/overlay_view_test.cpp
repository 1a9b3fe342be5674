#include "io/drawing/overlay_view.h"

#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "body/motion.h"
#include "tests/camera/sample_cameras.h"

namespace walktrack {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

Camera camera_of_size(int width, int height) {
  Camera camera = sample_camera({"pinhole", {}});
  camera.focal_px *= width / double(camera.width_px);
  camera.centre_px = Vector2d(width - 1, height - 1) / 2;
  camera.width_px = width;
  camera.height_px = height;
  return camera;
}

TEST(WholeView, IsAtMostSoWideAndKeepsItsShape) {
  EXPECT_EQ(whole_view(camera_of_size(3840, 2160), 1280).size, cv::Size(1280, 720));
  EXPECT_EQ(whole_view(camera_of_size(1768, 994), 1280).size, cv::Size(1280, 720));
  EXPECT_EQ(whole_view(camera_of_size(640, 480), 1280).size, cv::Size(640, 480));
  EXPECT_EQ(whole_view(camera_of_size(720, 1280), 1280).size, cv::Size(720, 1280));
  EXPECT_EQ(whole_view(camera_of_size(3840, 2160), 0).size, cv::Size(3840, 2160));
  const OverlayView odd = whole_view(camera_of_size(641, 481), 0);
  EXPECT_EQ(odd.area, cv::Rect(0, 0, 641, 481));
  EXPECT_EQ(odd.size, cv::Size(640, 480));  // encoders need even sides
}

TEST(WholeView, StaysLargeEnoughForEncoders) {
  const OverlayView tiny = whole_view(camera_of_size(1, 1), 1);
  EXPECT_EQ(tiny.size, cv::Size(32, 32));
  cv::Mat shown;
  look_through(tiny, FrameSource(cv::Mat(1, 1, CV_8UC3, cv::Scalar::all(7)), 1), shown);
  EXPECT_EQ(shown.size(), tiny.size);
}

// The projection by the camera of a view is where the view shows the point, for any lens.
TEST(OverlayView, DrawsWhereThePictureIs) {
  const OverlayView view{{100, 60, 400, 300}, {160, 120}};
  for (const SampleCamera& lens : sample_lenses()) {
    const Camera camera = sample_camera(lens);
    const Camera seen = camera_of(view, camera);
    EXPECT_EQ(cv::Size(seen.width_px, seen.height_px), view.size);
    for (const Vector3d& point : {Vector3d(0, 0, 1), Vector3d(0.4, -0.3, 1.6)})
      EXPECT_NEAR((*project(seen, point) - in_view(view, *project(camera, point))).norm(), 0, 1e-9)
          << lens.name;
  }
}

// The middle of a bright disc is where in_view says, for any scale.
TEST(OverlayView, ShowsAPointAtItsPlace) {
  cv::Mat picture(2160, 3840, CV_8UC3, cv::Scalar::all(0));
  const Vector2d middle(2003, 777);
  cv::circle(picture, {2003, 777}, 40, cv::Scalar::all(255), cv::FILLED, cv::LINE_AA);
  for (const OverlayView& view :
       {OverlayView{{0, 0, 3840, 2160}, {1280, 720}}, OverlayView{{0, 0, 3840, 2160}, {960, 540}},
        OverlayView{{1900, 700, 301, 201}, {602, 402}},
        OverlayView{{1900, 700, 300, 200}, {300, 200}},
        OverlayView{{1, 3, 3837, 2155}, {640, 360}}}) {
    cv::Mat shown, grey;
    look_through(view, FrameSource(picture, 1), shown);
    ASSERT_EQ(shown.size(), view.size);
    cv::cvtColor(shown, grey, cv::COLOR_BGR2GRAY);
    const cv::Moments moments = cv::moments(grey);
    const Vector2d found(moments.m10 / moments.m00, moments.m01 / moments.m00);
    EXPECT_LT((found - in_view(view, middle)).norm(), 0.05) << view.size;
  }
}

TEST(OverlayView, LeavesThePictureAsItIs) {
  const cv::Mat picture(480, 640, CV_8UC3, cv::Scalar::all(9));
  cv::Mat shown;
  look_through(whole_view(camera_of_size(640, 480), 1280), FrameSource(picture, 1), shown);
  shown.setTo(cv::Scalar::all(200));
  EXPECT_EQ(picture.at<cv::Vec3b>(5, 5)[0], 9);
}

JointPositions person_at(double x, double y) {
  JointPositions joints = unknown_joints();
  joints[Joint::kPelvis] = {x, y, 0.95};
  joints[Joint::kHead] = {x, y, 1.65};
  joints[Joint::kLeftToe] = {x + 0.4, y, 0.05};
  joints[Joint::kRightToe] = {x - 0.3, y, 0.2};
  return joints;
}

class ViewsAround : public testing::Test {
 protected:
  void expect_holds(const OverlayView& view, const JointPositions& joints) const {
    EXPECT_EQ(view.area & cv::Rect(0, 0, camera_.width_px, camera_.height_px), view.area);
    for (const Vector3d& joint : joints.at) {
      const auto px = known(joint) ? project(camera_, joint) : std::nullopt;
      if (!px || !inside_image(camera_, *px)) continue;
      EXPECT_TRUE(view.area.contains({int(std::lround(px->x())), int(std::lround(px->y()))}))
          << px->transpose() << " in " << view.area;
    }
  }
  const Camera camera_ = camera_of_size(1920, 1440);
};

TEST_F(ViewsAround, FollowTheWalkerInOneSize) {
  std::vector<JointPositions> frames;
  for (int i = 0; i < 80; ++i) frames.push_back(person_at(-4 + 0.1 * i, 0.01 * i));
  const std::vector<OverlayView> views = views_around(camera_, frames, 1280);
  ASSERT_EQ(views.size(), frames.size());
  for (size_t i = 0; i < views.size(); ++i) {
    EXPECT_EQ(views[i].area.size(), views[0].area.size());
    EXPECT_EQ(views[i].size, views[0].size);
    expect_holds(views[i], frames[i]);
  }
  EXPECT_LT(views[0].area.width, camera_.width_px / 2);
  EXPECT_NE(views[30].area.x, views[50].area.x);
  EXPECT_LE(views[0].size.width, 1280);
}

TEST_F(ViewsAround, MoveEvenlyWhereNobodyIsTracked) {
  std::vector<JointPositions> frames(31, unknown_joints());
  frames[10] = person_at(-1, 0);
  frames[20] = person_at(1, 0);
  const std::vector<OverlayView> views = views_around(camera_, frames, 0);
  EXPECT_EQ(views[0].area, views[10].area);
  EXPECT_EQ(views[30].area, views[20].area);
  EXPECT_NEAR(views[15].area.x, 0.5 * (views[10].area.x + views[20].area.x), 1);
}

TEST_F(ViewsAround, AreTheWholePictureWhereNobodyIsInIt) {
  const std::vector<JointPositions> frames{unknown_joints(), person_at(500, 0)};
  const std::vector<OverlayView> views = views_around(camera_, frames, 960);
  ASSERT_EQ(views.size(), 2u);
  for (const OverlayView& view : views) {
    EXPECT_EQ(view.area, cv::Rect(0, 0, 1920, 1440));
    EXPECT_EQ(view.size, cv::Size(960, 720));
  }
}

// A person 100 px high is enlarged, and one 1,000 px high is not shown too wide.
TEST_F(ViewsAround, AreOfASizeToLookAt) {
  const Camera coarse = camera_of_size(320, 240);
  const std::vector<JointPositions> frames{person_at(0, 0), person_at(0.5, 0)};
  EXPECT_GE(views_around(coarse, frames, 1280)[0].size.height, 470);
  EXPECT_LE(views_around(camera_of_size(8000, 6000), frames, 640)[0].size.width, 640);
}

}  // namespace
}  // namespace walktrack
