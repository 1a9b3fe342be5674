// Calibrations of Vicon (.xcp) and HumanEva (.cal). The files are the seeds of the fuzz targets,
// made by hand according to the sources that the readers name, because no real file was available.
#include <algorithm>
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/errors.h"
#include "io/archive/files.h"
#include "io/calibration/calibration.h"
#include "io/calibration/formats/humaneva.h"
#include "io/calibration/formats/vicon.h"
#include "io/scene/scene.h"
#include "tests/io/sample_files.h"
#include "tests/message_of.h"

namespace walktrack {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(ViconCalibration, NamesVideoCamerasThatAreCalibrated) {
  const std::string text = calibration_corpus("vicon/rig.xcp");
  EXPECT_THAT(vicon_names(text, "c"), ElementsAre("2111001"));
  std::string marker_cameras = replaced(text, "DISPLAY_TYPE=\"Vue\"", "DISPLAY_TYPE=\"T10\"");
  marker_cameras = replaced(marker_cameras, "TYPE=\"BonitaVideo\"", "TYPE=\"DxCore\"");
  EXPECT_THAT(vicon_names(marker_cameras, "c"), ElementsAre("2108001", "2111001"));
  EXPECT_THAT(vicon_names(replaced(text, "ISDV=\"0\"", "ISDV=\"2\""), "c"),
              ElementsAre("2108001", "2111001"));
}

TEST(ViconCalibration, IsInMetresAndOurAxes) {
  const Camera camera = camera_from_vicon(calibration_corpus("vicon/rig.xcp"), "c", "2111001");
  EXPECT_EQ(camera.width_px, 1920);
  EXPECT_EQ(camera.height_px, 1080);
  EXPECT_EQ(camera.focal_px, Vector2d(1650.5, 1650.5));
  EXPECT_EQ(camera.centre_px, Vector2d(958.5, 541.5));
  EXPECT_TRUE(camera_centre(camera).isApprox(Vector3d(0.5, -4, 1.5), 1e-12));
  // It looks along y: what is in front is in the middle, what is higher is further up, what has
  // larger x is further right.
  EXPECT_LT((*project(camera, Vector3d(0.5, 0, 1.5)) - Vector2d(958.5, 541.5)).norm(), 0.5);
  EXPECT_LT(project(camera, Vector3d(0.5, 0, 2.0))->y(), 400);
  EXPECT_GT(project(camera, Vector3d(1.0, 0, 1.5))->x(), 1100);
  // A marker camera looks along x.
  const Camera marker = camera_from_vicon(calibration_corpus("vicon/rig.xcp"), "c", "2108001");
  EXPECT_TRUE(camera_centre(marker).isApprox(Vector3d(-3, 0, 2.5), 1e-12));
  EXPECT_LT((*project(marker, Vector3d(2, 0, 2.5)) - Vector2d(1170, 860)).norm(), 0.5);
  EXPECT_GT(project(marker, Vector3d(2, -1, 2.5))->x(), 1400);
}

// Vicon's model corrects pixels; Camera distorts rays. Both agree in every part of the image.
TEST(ViconCalibration, LensesAreTurnedRound) {
  for (const char* name : {"2111001", "2108001"}) {
    const Camera camera = camera_from_vicon(calibration_corpus("vicon/rig.xcp"), "c", name);
    const bool three = std::string(name) == "2111001";
    const Vector2d centre = three ? Vector2d(962, 538) : camera.centre_px;
    const double k1 = three ? 6e-8 : 2e-8, k2 = three ? 2e-15 : 1e-15;
    double moved = 0;
    for (double u = 0; u < camera.width_px; u += 97)
      for (double v = 0; v < camera.height_px; v += 89) {
        const Vector2d away = Vector2d(u, v) - centre;
        const double d2 = away.squaredNorm();
        const Vector2d straight = centre + (1 + k1 * d2 + k2 * d2 * d2) * away;
        moved = std::max(moved, (straight - Vector2d(u, v)).norm());
        Vector3d ray;
        ray << (straight - camera.centre_px).cwiseQuotient(camera.focal_px), 1;
        const auto seen = project_camera_point(camera, ray);
        ASSERT_TRUE(seen);
        EXPECT_LT((*seen - Vector2d(u, v)).norm(), 0.5) << name << " at " << u << ", " << v;
      }
    EXPECT_GT(moved, 40) << "there was something to turn round";
  }
}

TEST(ViconCalibration, NamesWhatIsWrong) {
  const std::string sound = calibration_corpus("vicon/rig.xcp");
  const auto message = [&](const std::string& from, const std::string& to) {
    return message_of([&] { camera_from_vicon(replaced(sound, from, to), "c.xcp", "2111001"); });
  };
  EXPECT_THAT(message("DEVICEID=\"2111001\"", "DEVICEID=\"7\""),
              HasSubstr("c.xcp: found no camera '2111001', allowed: 7"));
  EXPECT_THAT(message_of([&] { camera_from_vicon(sound, "c.xcp", "2111002"); }),
              AllOf(HasSubstr("no <KeyFrame> element"), HasSubstr("'2111002' calibrated")));
  EXPECT_THAT(message("SENSOR_SIZE=\"1920 1080\"", "SENSOR_SIZE=\"1920\""),
              HasSubstr("SENSOR_SIZE: found '1920', allowed: 2 numbers"));
  EXPECT_THAT(message("SENSOR_SIZE=\"1920 1080\"", "SENSOR_SIZE=\"1920 -4\""),
              HasSubstr("whole numbers of pixels"));
  EXPECT_THAT(message("0.70710678118654752 0 0 0.7", "1.4 0 0 0.7"),
              HasSubstr("c.xcp:15: KeyFrame.ORIENTATION: found a quaternion of length 1.5"));
  EXPECT_THAT(message("POSITION=\"500 ", "POSITION=\"here "), HasSubstr("'here'"));
  EXPECT_THAT(message("Vicon3Parameter 962", "Vicon4Parameter 962"),
              HasSubstr("Vicon3Parameter and five numbers"));
  EXPECT_THAT(message("FOCAL_LENGTH=\"1650.5\"", "FOCAL_LENGTH=\"0\""),
              HasSubstr("a positive number"));
  // As if the coefficients had another unit.
  EXPECT_THAT(message(" 6e-08 ", " 0.06 "), HasSubstr("k1 k2 p1 p2 k3 describe only to"));
  EXPECT_THAT(message(" 6e-08 ", " 1e300 "), HasSubstr("a lens without end"));
  EXPECT_THAT(message("WORLD_ERROR=\"0.4\"/>",
                      "/>\n<KeyFrame ORIENTATION=\"0 0 0 1\" POSITION=\"0 0 0\"/>"),
              HasSubstr("allowed: a camera that stands still"));
  EXPECT_THAT(message_of([] { vicon_names("<Cameras>", "c"); }), HasSubstr("no <Camera> element"));
  std::string many;
  for (int i = 0; i < 300; ++i) many += "<Camera DEVICEID=\"1\">";
  EXPECT_THAT(message_of([&] { vicon_names(many, "c"); }), HasSubstr("more than 256 cameras"));
}

TEST(HumanevaCalibration, IsReadWithAStatedSize) {
  const std::string text = calibration_corpus("humaneva/c1.cal");
  const Camera camera = camera_from_humaneva(text, "c1.cal", ImageSize{640, 480});
  EXPECT_EQ(camera.width_px, 640);
  EXPECT_EQ(camera.focal_px, Vector2d(765.11614, 764.304443));
  EXPECT_EQ(camera.centre_px, Vector2d(324.53694, 246.905602));
  EXPECT_THAT(distortion_coefficients(camera),
              ElementsAre(-0.23915, 0.18177, 0.00054, -0.00026, 0));
  EXPECT_TRUE(camera_centre(camera).isApprox(Vector3d(0.2, -3.5, 1.1), 1e-9))
      << camera_centre(camera);
  EXPECT_LT(project(camera, Vector3d(0.2, 0, 1.5))->y(), 200) << "z is up";
  EXPECT_THAT(message_of([&] { camera_from_humaneva(text, "c1.cal"); }),
              AllOf(HasSubstr("c1.cal: found no image size"), HasSubstr("--image-size WxH")));
}

TEST(HumanevaCalibration, NamesWhatIsWrong) {
  const std::string sound = calibration_corpus("humaneva/c1.cal");
  const auto message = [&](const std::string& from, const std::string& to) {
    return message_of([&] {
      camera_from_humaneva(replaced(sound, from, to), "c1.cal", ImageSize{640, 480});
    });
  };
  EXPECT_THAT(message("765.116140 \n", ""), HasSubstr("found 21 numbers, allowed: the 22 of a"));
  EXPECT_THAT(message("765.116140", "focal"), HasSubstr("c1.cal:1: found 'focal'"));
  EXPECT_THAT(message("765.116140", "-765"), HasSubstr("positive focal lengths"));
  EXPECT_THAT(message("246.905602 \n0.000000", "246.905602 \n0.1"), HasSubstr("a skew of 0.1"));
  EXPECT_THAT(message("1.000000 \n0.000000 \n0.000000 \n0.000000", "-1 0 0 0"),
              HasSubstr("c1.cal:11: rotation: found a mirrored matrix"));
  EXPECT_THAT(message_of([] { camera_from_humaneva("", "c1.cal"); }), HasSubstr("0 numbers"));
}

TEST(LaboratoryCalibration, IsTakenByASceneAsItsEndingSays) {
  const TemporaryFolder folder;
  folder.write("rig.xcp", calibration_corpus("vicon/rig.xcp"));
  folder.write("c1.CAL", calibration_corpus("humaneva/c1.cal"));
  folder.write("video.mp4", "");
  const Scene scene = read_scene(folder.write(
      "scene.yaml", "cameras:\n  - {name: '2111001', video: video.mp4, calibration: rig.xcp}\n"));
  EXPECT_EQ(scene.cameras[0].camera.width_px, 1920);
  EXPECT_THAT(calibration_names(folder / "rig.xcp"), ElementsAre("2111001"));
  EXPECT_EQ(read_calibration(folder / "c1.CAL", "c1", ImageSize{644, 488}).height_px, 488);
}

}  // namespace
}  // namespace walktrack
