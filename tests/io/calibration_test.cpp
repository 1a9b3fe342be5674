#include "io/calibration/calibration.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "core/errors.h"
#include "io/calibration/calibration_checks.h"
#include "io/calibration/formats/opencv.h"
#include "tests/camera/sample_cameras.h"
#include "tests/io/sample_files.h"

namespace walktrack {
namespace {

using testing::HasSubstr;

std::string message_for(const std::string& text) {
  try {
    camera_from_opencv(text, "c.yaml");
  } catch (const InputError& error) {
    return error.what();
  }
  return "no InputError";
}

std::string message_with(const std::string& from, const std::string& to) {
  return message_for(replaced(kCalibrationText, from, to));
}

void expect_same(const Camera& a, const Camera& b) {
  EXPECT_EQ(a.width_px, b.width_px);
  EXPECT_EQ(a.height_px, b.height_px);
  EXPECT_EQ(a.focal_px, b.focal_px);
  EXPECT_EQ(a.centre_px, b.centre_px);
  EXPECT_EQ(a.rotation, b.rotation);
  EXPECT_EQ(a.translation, b.translation);
  EXPECT_EQ(a.lens, b.lens);
  EXPECT_EQ(a.distortion, b.distortion);
}

TEST(OpenCvCalibration, ReadsWhatOpenCvWrites) {
  const Camera camera = camera_from_opencv(kCalibrationText, "c.yaml");
  EXPECT_EQ(camera.width_px, 64);
  EXPECT_EQ(camera.height_px, 48);
  EXPECT_EQ(camera.focal_px, Eigen::Vector2d(60, 60));
  EXPECT_EQ(camera.centre_px, Eigen::Vector2d(31.5, 23.5));
  EXPECT_EQ(camera.lens, Lens::kBrown);
  EXPECT_EQ(camera.distortion[1], 0.02);
  EXPECT_LT((camera_centre(camera) - Eigen::Vector3d(0, -5, 1)).norm(), 1e-12);
}

TEST(OpenCvCalibration, RoundTripsEveryLensBitForBit) {
  for (const SampleCamera& lens : sample_lenses()) {
    const Camera camera = sample_camera(lens);
    expect_same(camera_from_opencv(opencv_from_camera(camera), lens.name), camera);
  }
}

TEST(OpenCvCalibration, TakesPlainListsAndRodrigues) {
  const Camera camera = camera_from_opencv(
      "image_width: 64\nimage_height: 48\n"
      "camera_matrix: [[60, 0, 31.5], [0, 60, 23.5], [0, 0, 1]]\n"
      "rotation: [1.5707963267948966, 0, 0]\ntranslation: [0, 1, 5]\nrms: 0.3\n",
      "c.yaml");
  EXPECT_EQ(camera.lens, Lens::kPinhole);
  Eigen::Matrix3d expected;
  expected << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  EXPECT_LT((camera.rotation - expected).norm(), 1e-15);
}

TEST(OpenCvCalibration, MakesARoundedRotationExact) {
  const Camera camera =
      camera_from_opencv(replaced(kCalibrationText, "1., 0., 0., 0., 0., -1., 0., 1., 0.",
                                  "0.936, 0.352, 0, 0, 0, -1, -0.352, 0.936, 0"),
                         "c.yaml");
  EXPECT_LT((camera.rotation.transpose() * camera.rotation - Eigen::Matrix3d::Identity()).norm(),
            1e-14);
  EXPECT_NEAR(camera.rotation(0, 0), 0.936, 1e-3);
}

TEST(OpenCvCalibration, NamesWhatIsWrong) {
  EXPECT_THAT(message_with("image_width: 64", "image_width: 0"),
              HasSubstr("c.yaml:3: image_width: found '0', allowed: a whole number from 1"));
  EXPECT_THAT(message_with("image_width: 64\n", ""), HasSubstr("image_width: found nothing"));
  EXPECT_THAT(message_with("60., 0., 31.5", "-60., 0., 31.5"), HasSubstr("focal lengths -60, 60"));
  EXPECT_THAT(message_with("60., 0., 31.5", "60., 0.5, 31.5"), HasSubstr("a skew of 0.5"));
  EXPECT_THAT(message_with("60., 0., 31.5, 0., 60., 23.5, 0., 0., 1.",
                           "60., 0., 0., 0., 60., 0., 31.5, 23.5, 1."),
              HasSubstr("c.yaml:5: camera_matrix: found a transposed matrix"));
  EXPECT_THAT(message_with("-0.1, 0.02, 0., 0., 0.", "-0.1, 0.02, 0."),
              HasSubstr("distortion_coefficients: found 3 numbers"));
  EXPECT_THAT(message_with("-0.1, 0.02", ".nan, 0.02"), HasSubstr("found '.nan'"));
  EXPECT_THAT(message_with("0., 1., 5.", "0., 1."),
              HasSubstr("translation: found 2 numbers, allowed: 3 numbers"));
}

TEST(OpenCvCalibration, RefusesMatricesThatAreNoRotation) {
  const std::string good = "1., 0., 0., 0., 0., -1., 0., 1., 0.";
  EXPECT_THAT(message_with(good, "1, 0, 0, 0, 0, 1, 0, 1, 0"), HasSubstr("a mirrored matrix"));
  EXPECT_THAT(message_with(good, "2, 0, 0, 0, 0, -2, 0, 2, 0"),
              HasSubstr("a rotation scaled by 2"));
  EXPECT_THAT(message_with(good, "1, 0, 0, 0, 0, -1, 0, 1, 0.2"),
              HasSubstr("a matrix that is not a rotation"));
  EXPECT_THAT(message_with(good, "0, 0, 0, 0, 0, 0, 0, 0, 0"),
              HasSubstr("a matrix that is not a rotation"));
}

TEST(ReadCalibration, NamesTheFormatsItKnows) {
  const TemporaryFolder folder;
  EXPECT_THROW(read_calibration(folder.write("a.txt", ""), "a"), InputError);
  EXPECT_THROW(read_calibration(folder / "none.yaml", "a"), InputError);
  EXPECT_EQ(read_calibration(folder.write("a.YML", kCalibrationText), "a").width_px, 64);
}

TEST(ReadCalibration, ReadsTheRealPetsCamera) {
  const std::string file = shared_data("pets_view001/view001.yaml");
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no " << file;
  const Camera camera = read_calibration(file, "view001");
  EXPECT_EQ(camera.width_px, 768);
  // The camera is on a roof and looks down from several metres.
  EXPECT_GT(camera_centre(camera).z(), 5);
  EXPECT_LT(camera.rotation(2, 2), 0);
}

// Of a matrix with few digits. Q is the rotation nearest to M if Q'M is symmetric and positive
// definite (Higham 1986): M = Q S.
TEST(CheckedRotation, IsTheNearestOne) {
  Eigen::Matrix3d rounded =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  rounded(0, 1) += 2e-4;
  rounded(2, 0) -= 1e-4;
  const Eigen::Matrix3d q = checked_rotation(rounded, [](auto...) { FAIL(); });
  EXPECT_LT((q.transpose() * q - Eigen::Matrix3d::Identity()).norm(), 1e-14);
  const Eigen::Matrix3d s = q.transpose() * rounded;
  EXPECT_LT((s - s.transpose()).norm(), 1e-14);
  EXPECT_GT(s.diagonal().minCoeff(), 0.99);
}

}  // namespace
}  // namespace walktrack
