#include "camera/inspection.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "core/conventions.h"
#include "tests/camera/sample_cameras.h"

namespace walktrack {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// A camera at `height`, looking along y, tilted down and then rolled clockwise about its axis.
Camera placed(double height, double tilt, double roll) {
  Camera camera;
  camera.width_px = 640;
  camera.height_px = 480;
  camera.focal_px = {500, 500};
  camera.centre_px = {319.5, 239.5};
  camera.rotation << 1, 0, 0, 0, -std::sin(tilt), -std::cos(tilt), 0, std::cos(tilt),
      -std::sin(tilt);
  camera.rotation = Eigen::AngleAxisd(roll, Vector3d::UnitZ()) * camera.rotation;
  camera.translation = -camera.rotation * Vector3d(0, 0, height);
  return camera;
}

TEST(InspectCamera, ReadsHeightTiltRollAndView) {
  for (const double tilt : {0.0, 0.3, 1.2}) {
    for (const double roll : {0.0, 0.4, -1.0, 3.0}) {
      const CameraInspection seen = inspect_camera(placed(2.5, tilt, roll), 1.75);
      EXPECT_NEAR(seen.centre.z(), 2.5, 1e-12);
      EXPECT_NEAR(seen.tilt, tilt, 1e-12);
      EXPECT_NEAR(std::abs(seen.roll), std::abs(roll), 1e-12);
      EXPECT_NEAR(seen.horizontal_view, 2 * std::atan(319.5 / 500), 1e-12);
      EXPECT_NEAR(seen.vertical_view, 2 * std::atan(239.5 / 500), 1e-12);
    }
  }
}

TEST(InspectCamera, FindsWhereAPersonIsSeenWhole) {
  const Camera camera = placed(2.5, 0.2, 0);
  const CameraInspection seen = inspect_camera(camera, 1.75);
  ASSERT_TRUE(seen.standing_place);
  EXPECT_TRUE(sees_person(camera, *seen.standing_place, 1.75));
  // About focal length x height / distance.
  EXPECT_NEAR(seen.person_px, 500 * 1.75 / seen.standing_place->y(), 0.15 * seen.person_px);
  EXPECT_FALSE(sees_person(camera, {0, -5}, 1.75));  // behind
  EXPECT_FALSE(sees_person(camera, {0, 1}, 1.75));   // head above the image
}

// Both sides of a walkway, which is so close that the person seen best by one camera stands behind
// the other.
TEST(ShareAView, OfCamerasThatFaceEachOther) {
  const Camera near_side = placed(1, 0, 0);
  const auto facing = [](double distance) {  // the other way from (0, distance)
    Camera camera = placed(1, 0, 0);
    camera.rotation = camera.rotation * Eigen::AngleAxisd(kPi, Vector3d::UnitZ());
    camera.translation = -camera.rotation * Vector3d(0, distance, 1);
    return camera;
  };
  const Vector2d place = *inspect_camera(near_side, 1.75).standing_place;
  EXPECT_FALSE(sees_person(facing(4.6), place, 1.75));
  EXPECT_TRUE(share_a_view(near_side, facing(4.6), 1.75));
  EXPECT_TRUE(share_a_view(facing(4.6), near_side, 1.75));
  EXPECT_FALSE(share_a_view(near_side, facing(-0.5), 1.75)) << "back to back";
}

TEST(InspectCamera, SeesNoGroundFromBelowOrUpwards) {
  EXPECT_TRUE(inspect_camera(placed(-1, 0.2, 0), 1.75).footprint.empty());
  EXPECT_FALSE(inspect_camera(placed(2, -1.2, 0), 1.75).standing_place);
}

TEST(InspectCamera, FootprintLiesBelowTheBorder) {
  const Camera camera = placed(3, 0.6, 0.1);
  for (const Vector2d& point : inspect_camera(camera, 1.75).footprint) {
    const auto pixel = project(camera, {point.x(), point.y(), 0});
    ASSERT_TRUE(pixel);
    const double to_border = std::min({pixel->x(), pixel->y(), 639 - pixel->x(), 479 - pixel->y()});
    EXPECT_NEAR(to_border, 0, 1e-6);
  }
}

TEST(LensCoversImage, NoticesAFoldInsideTheImage) {
  for (const SampleCamera& lens : sample_lenses()) {
    EXPECT_TRUE(lens_covers_image(sample_camera(lens))) << lens.name;
  }
  // r (1 - 1.5 r^2) has its maximum at r = 0.47; the corner is at 0.76.
  EXPECT_FALSE(lens_covers_image(sample_camera({"folding", {-1.5, 0, 0, 0, 0}})));
}

}  // namespace
}  // namespace walktrack
