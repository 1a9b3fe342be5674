// Calibration files of other tools: small ones of the same form, and real ones.
#include <algorithm>
#include <cmath>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/errors.h"
#include "io/calibration/calibration.h"
#include "io/calibration/formats/toml.h"
#include "io/calibration/formats/tsai.h"
#include "tests/camera/sample_cameras.h"
#include "tests/io/sample_files.h"
#include "tests/message_of.h"

namespace walktrack {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using testing::HasSubstr;

const std::string kToml =
    "[cam_01]\nname = \"left\"\nsize = [ 1088.0, 1920.0]\n"
    "matrix = [ [ 1681.2, 0.0, 533.0], [ 0.0, 1681.1, 948.1], [ 0.0, 0.0, 1.0]]\n"
    "distortions = [ -0.07, 0.02, 1e-4, 2e-5]\nrotation = [ 1.7, 1.0, -0.4]\n"
    "translation = [ 0.3, 0.9, 2.9]\nfisheye = false\n\n"
    "[cam_02]\nname = \"right\"\nsize = [ 640, 480]\n"
    "matrix = [ [ 300, 0, 320], [ 0, 300, 240], [ 0, 0, 1]]\n"
    "distortions = [ 0.1, 0.0, 0.0, 0.0]\nrotation = [ 0.0, 0.0, 0.0]\n"
    "translation = [ 0, 0, 5]\nfisheye = true\n\n"
    "[metadata]\nadjusted = false\nerror = 0.0\n";

const std::string kTsai =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<Camera name=\"a\">\n"
    "\t<Geometry width=\"768\" height=\"576\" ncx=\"795\" nfx=\"752\" dx=\"4.85e-03\" "
    "dy=\"4.65e-03\" dpx=\"5.1e-03\" dpy=\"4.65e-03\"/>\n"
    "\t<Intrinsic focal=\"5.5\" kappa1=\"5.0e-03\" cx=\"324.2\" cy=\"282.5\" sx=\"1.09\"/>\n"
    "\t<Extrinsic tx=\"800\" ty=\"-3000\" tz=\"35000\" rx=\"2.0\" ry=\"-0.9\" rz=\"-0.4\"/>\n"
    "</Camera>\n";

TEST(TomlCalibration, FindsTheCameraByEitherName) {
  for (const char* name : {"cam_01", "left"}) {
    const Camera camera = camera_from_toml(kToml, "c.toml", name);
    EXPECT_EQ(camera.width_px, 1088);
    EXPECT_EQ(camera.height_px, 1920);
    EXPECT_EQ(camera.focal_px, Vector2d(1681.2, 1681.1));
    EXPECT_EQ(camera.lens, Lens::kBrown);
    EXPECT_EQ(camera.translation, Vector3d(0.3, 0.9, 2.9));
  }
  const Camera fisheye = camera_from_toml(kToml, "c.toml", "right");
  EXPECT_EQ(fisheye.lens, Lens::kFisheye);
  EXPECT_EQ(fisheye.rotation, Eigen::Matrix3d::Identity());
}

TEST(TomlCalibration, NamesWhatIsWrong) {
  const auto message = [](const std::string& from, const std::string& to) {
    return message_of([&] { camera_from_toml(replaced(kToml, from, to), "c.toml", "left"); });
  };
  EXPECT_THAT(message_of([] { camera_from_toml(kToml, "c.toml", "centre"); }),
              HasSubstr("c.toml: found no camera 'centre', allowed: cam_01, left, cam_02, right"));
  EXPECT_THAT(message("[cam_01]", "[cam_01"), HasSubstr("c.toml:1: found broken TOML"));
  EXPECT_THAT(message("1088.0,", "1088.5,"), HasSubstr("c.toml:3: left.size: found 1088.5"));
  EXPECT_THAT(message("1681.2,", "-1681.2,"), HasSubstr("c.toml:4: left.matrix: found focal"));
  EXPECT_THAT(message("-0.07, 0.02,", ""), HasSubstr("left.distortions: found 2 numbers"));
  EXPECT_THAT(message("1.7, 1.0,", "1.7,"), HasSubstr("left.rotation: found 2 numbers"));
  EXPECT_THAT(message("0.3, 0.9", "nan, 0.9"), HasSubstr("left.translation: found an entry"));
  EXPECT_THAT(message("translation", "translocation"),
              HasSubstr("left.translation: found nothing"));
}

TEST(TomlCalibration, RoundTripsEveryLens) {
  std::vector<std::pair<std::string, Camera>> cameras;
  for (const SampleCamera& lens : sample_lenses()) {
    cameras.emplace_back(lens.name, sample_camera(lens));
  }
  cameras.emplace_back("a \"strange\" näme", cameras[0].second);
  const std::string text = toml_from_cameras(cameras);
  for (const auto& [name, camera] : cameras) {
    const Camera back = camera_from_toml(text, "c.toml", name);
    EXPECT_EQ(back.focal_px, camera.focal_px) << name;
    EXPECT_EQ(back.distortion, camera.distortion) << name;
    EXPECT_EQ(back.lens, camera.lens) << name;
    EXPECT_EQ(back.translation, camera.translation) << name;
    EXPECT_LT((back.rotation - camera.rotation).norm(), 1e-14) << name;
  }
}

// Tsai's own formulas, from a distorted pixel to a ray: X_u = X_d (1 + kappa1 r_d^2), mm.
TEST(TsaiCalibration, RaysAreThoseOfTsaisFormulas) {
  const Camera camera = camera_from_tsai(kTsai, "c.xml");
  for (const Vector2d& pixel : {Vector2d(0, 0), Vector2d(767, 0), Vector2d(400, 570)}) {
    const double x = (pixel.x() - 324.2) * 5.1e-3 / 1.09, y = (pixel.y() - 282.5) * 4.65e-3;
    const Vector2d truth = Vector2d(x, y) * (1 + 5.0e-3 * (x * x + y * y)) / 5.5;
    const auto ray = unproject(camera, pixel);
    ASSERT_TRUE(ray);
    const Vector3d ahead = camera.rotation * ray->direction;
    // The fitted polynomial is good to 1e-3 px at this focal length of 1,180 px.
    EXPECT_LT((ahead.head<2>() / ahead.z() - truth).norm(), 1e-6);
  }
}

TEST(TsaiCalibration, NamesWhatIsWrong) {
  const auto message = [](const std::string& from, const std::string& to) {
    return message_of([&] { camera_from_tsai(replaced(kTsai, from, to), "c.xml"); });
  };
  EXPECT_THAT(message("<Extrinsic", "<Outer"), HasSubstr("c.xml: found no <Extrinsic> element"));
  EXPECT_THAT(message(" focal=\"5.5\"", ""), HasSubstr("c.xml:4: Intrinsic.focal: found nothing"));
  EXPECT_THAT(message("\"5.5\"", "\"5,5\""), HasSubstr("Intrinsic.focal: found '5,5'"));
  EXPECT_THAT(message("\"5.5\"", "\"-5\""), HasSubstr("found -5, allowed: a positive number"));
  EXPECT_THAT(message("\"768\"", "\"768.5\""), HasSubstr("Geometry.width: found 768.5"));
  EXPECT_THAT(message_of([] { camera_from_tsai("<opencv_storage>", "c.xml"); }),
              HasSubstr("allowed: a Tsai calibration"));
}

// Largest distance, px, between two cameras' images of points in front of both.
double largest_difference(const Camera& a, const Camera& b) {
  double largest = 0;
  for (double u = 0; u < a.width_px; u += 50) {
    for (double v = 0; v < a.height_px; v += 50) {
      const auto ray = unproject(a, Vector2d(u, v));
      const auto seen = project(b, ray->origin + 10 * ray->direction);
      largest = std::max(largest, seen ? (*seen - Vector2d(u, v)).norm() : 1e9);
    }
  }
  return largest;
}

TEST(TsaiCalibration, AgreesWithTheOpenCvFileOfTheRealPetsCamera) {
  const std::string tsai = shared_data("calibration/View_001.xml");
  if (!std::filesystem::exists(tsai)) GTEST_SKIP() << "no " << tsai;
  const Camera opencv = read_calibration(shared_data("pets_view001/view001.yaml"), "view001");
  // The OpenCV file was fitted by somebody else and is stated to agree within 0.0002 px.
  EXPECT_LT(largest_difference(read_calibration(tsai, "view001"), opencv), 1e-3);
  EXPECT_NO_THROW(read_calibration(shared_data("calibration/View_005.xml"), "view005"));
}

TEST(TomlCalibration, AgreesWithTheOpenCvFilesOfARealRig) {
  const std::string toml = shared_data("calibration/pose2sim_qualisys.toml");
  if (!std::filesystem::exists(toml)) GTEST_SKIP() << "no " << toml;
  for (const char* name : {"cam_01", "cam_02", "cam_03", "cam_04"}) {
    EXPECT_EQ(read_calibration(toml, name).width_px, 1088) << name;
  }
  // The scene's OpenCV files have the same poses; their images are cropped and shrunk.
  const Camera a = read_calibration(toml, "cam_01");
  const Camera b = read_calibration(shared_data("pose2sim_balance/cam01.yaml"), "cam01");
  EXPECT_LT((a.rotation - b.rotation).norm(), 1e-9);
  EXPECT_LT((a.translation - b.translation).norm(), 1e-9);
  const Camera demo = read_calibration(shared_data("calibration/sports2d.toml"), "demo");
  EXPECT_EQ(demo.width_px, 1768);
  EXPECT_GT(camera_centre(demo).z(), 0.5);
}

}  // namespace
}  // namespace walktrack
