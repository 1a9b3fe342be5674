// Calibrations of OpenCap, Qualisys and EasyMocap. The files are the seeds of the fuzz targets; the
// pickles were written by numpy 1.24.
#include <algorithm>
#include <array>
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/errors.h"
#include "io/archive/files.h"
#include "io/calibration/calibration.h"
#include "io/calibration/formats/opencap.h"
#include "io/calibration/formats/qualisys.h"
#include "io/calibration/pickle.h"
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

Eigen::Matrix3d turned() {
  Eigen::Matrix3d out;
  out << 0, 1, 0, 0, 0, -1, -1, 0, 0;
  return out;
}

TEST(OpencapCalibration, IsReadInEveryProtocol) {
  for (const char* name : {"protocol2", "protocol4", "protocol5", "columns_first"}) {
    const Camera camera =
        camera_from_opencap(calibration_corpus("opencap/" + std::string(name) + ".pickle"), name);
    EXPECT_EQ(camera.width_px, 720) << name;
    EXPECT_EQ(camera.height_px, 1280) << name;
    EXPECT_EQ(camera.focal_px, Vector2d(856.5, 857.5)) << name;
    EXPECT_EQ(camera.centre_px, Vector2d(356.25, 637.5)) << name;
    EXPECT_TRUE(camera.rotation.isApprox(turned(), 1e-12)) << name << "\n" << camera.rotation;
    EXPECT_TRUE(camera.translation.isApprox(Vector3d(-0.1325, 0.7225, 2.566), 1e-12)) << name;
    EXPECT_THAT(distortion_coefficients(camera), ElementsAre(0.2, -0.6, -0.0005, 0.001, 0.5))
        << name;
  }
}

TEST(OpencapCalibration, NeverCallsAnything) {
  const std::string message = message_of([] {
    camera_from_opencap(calibration_corpus("opencap/calls_a_program.pickle"), "c.pickle");
  });
  EXPECT_THAT(message, AllOf(HasSubstr("c.pickle"), HasSubstr("'posix.system'"),
                             HasSubstr("allowed: a dictionary of numpy arrays")));
}

TEST(OpencapCalibration, NamesWhatIsWrong) {
  const std::string sound = calibration_corpus("opencap/protocol4.pickle");
  const auto message = [&](const std::string& from, const std::string& to) {
    return message_of([&] { camera_from_opencap(replaced(sound, from, to), "c.pickle"); });
  };
  EXPECT_THAT(message("imageSize", "imageSide"), HasSubstr("c.pickle: imageSize: found nothing"));
  EXPECT_THAT(message("translation", "trans_ation"), HasSubstr("translation: found nothing"));
  EXPECT_THAT(message("ndarray", "ndarroy"), HasSubstr("'numpy.ndarroy'"));
  EXPECT_THAT(message("f8", "O8"), HasSubstr("an array of type 'O8'"));
  EXPECT_THAT(message_of([] { camera_from_opencap("", "c.pickle"); }), HasSubstr("the end of the"));
  EXPECT_THAT(message_of([] { camera_from_opencap(std::string(1u << 20, 'N'), "c.pickle"); }),
              HasSubstr("found 1048576 bytes"));
}

TEST(OpencapCalibration, RefusesEveryPieceOfAFile) {
  const std::string sound = calibration_corpus("opencap/protocol4.pickle");
  for (size_t length = 0; length < sound.size(); ++length)
    EXPECT_THROW(camera_from_opencap(sound.substr(0, length), "c.pickle"), InputError) << length;
}

// A dictionary with one array of 300 zeros under many names, as numpy writes it in protocol 5.
std::string shared_array(int names) {
  using namespace std::string_literals;
  std::string out = "\x80\x05}"s + "\x8c\x01" + "a" + "\x8c\x12numpy.core.numeric" +
                    "\x8c\x0b_frombuffer" + "\x93(" + "B\x60\x09\0\0"s + std::string(2400, '\0') +
                    "cnumpy\ndtype\n" + "\x8c\x02" + "f8" + "\x85R" + "M\x2c\x01" + "\x85" +
                    "\x8c\x01" + "C" + "tRq\x07" + "s";
  for (int i = 0; i < names; ++i) out += "\x8c\x01"s + "k" + "h\x07" + "s";
  return out + ".";
}

// Memory is limited by the file's size, however often the file refers to one array.
TEST(Pickle, DoesNotMultiplyWhatAFileHolds) {
  const auto arrays = read_pickled_arrays(shared_array(100), "c.pickle");
  ASSERT_EQ(arrays.size(), 2u);
  EXPECT_THAT(arrays.at("k").shape, ElementsAre(300u));
  EXPECT_THAT(message_of([] { read_pickled_arrays(shared_array(1000), "c.pickle"); }),
              HasSubstr("more numbers than the file is long"));
}

TEST(QualisysCalibration, IsInPixelsMetresAndOurAxes) {
  const std::string text = calibration_corpus("qualisys/two.xml");
  EXPECT_THAT(qualisys_names(text, "c"), ElementsAre("21001", "21002"));
  const Camera camera = camera_from_qualisys(text, "c", "21001");
  EXPECT_EQ(camera.width_px, 1920);
  EXPECT_EQ(camera.height_px, 1080);
  EXPECT_EQ(camera.focal_px, Vector2d(1100, 1102));
  EXPECT_EQ(camera.centre_px, Vector2d(960, 540));
  EXPECT_THAT(distortion_coefficients(camera), ElementsAre(-0.1, 0.02, 0.001, -0.002, 0.01));
  EXPECT_TRUE(camera_centre(camera).isApprox(Vector3d(0.5, -4, 1.5), 1e-12));
  // It looks along y with z up: what is in front is in the middle, what is higher is further up,
  // what has larger x is further right.
  EXPECT_TRUE(project(camera, Vector3d(0.5, 0, 1.5))->isApprox(Vector2d(960, 540), 1e-9));
  EXPECT_LT(project(camera, Vector3d(0.5, 0, 2.0))->y(), 450);
  EXPECT_GT(project(camera, Vector3d(1.0, 0, 1.5))->x(), 1050);
}

TEST(QualisysCalibration, TakesTheVideosWindow) {
  const Camera camera = camera_from_qualisys(calibration_corpus("qualisys/two.xml"), "c", "21002");
  EXPECT_EQ(camera.width_px, 1720);
  EXPECT_EQ(camera.height_px, 980);
  EXPECT_EQ(camera.centre_px, Vector2d(860, 490));
  EXPECT_TRUE(camera_centre(camera).isApprox(Vector3d(4, 0, 1.2), 1e-12));
}

TEST(QualisysCalibration, NamesWhatIsWrong) {
  const std::string sound = calibration_corpus("qualisys/two.xml");
  const auto message = [&](const std::string& from, const std::string& to) {
    return message_of(
        [&] { camera_from_qualisys(replaced(sound, from, to), "c.qca.txt", "21001"); });
  };
  EXPECT_THAT(message("21001", "21003"),
              HasSubstr("c.qca.txt: found no camera '21001', allowed: 21003, 21002"));
  EXPECT_THAT(message("r11=\"1\"", "r11=\"2\""), HasSubstr("c.qca.txt:6: transform"));
  EXPECT_THAT(message("focalLengthU=\"70400\"", ""), HasSubstr("focalLengthU: found nothing"));
  EXPECT_THAT(message("right=\"1919\"", "right=\"-5\""), HasSubstr("-4 pixels"));
  // Missing values of the first camera are not taken from the second.
  EXPECT_THAT(message("<intrinsic ", "<lens "), HasSubstr("no <intrinsic> element"));
  EXPECT_THAT(message_of([] { qualisys_names("<calibration>", "c"); }), HasSubstr("no <camera>"));
  std::string many;
  for (int i = 0; i < 300; ++i) many += "<camera serial=\"1\">";
  EXPECT_THAT(message_of([&] { qualisys_names(many, "c"); }), HasSubstr("more than 256 cameras"));
}

TEST(QualisysCalibration, AgreesWithTheTomlFileOfTheSameRealRig) {
  const std::string qualisys = shared_data("calibration/qualisys.qca.txt");
  if (!std::filesystem::exists(qualisys)) GTEST_SKIP() << "no " << qualisys;
  EXPECT_THAT(calibration_names(qualisys), ElementsAre("cam01", "cam02", "cam03", "cam04"));
  for (const char* number : {"01", "02"}) {
    const Camera a = read_calibration(qualisys, "cam" + std::string(number));
    const Camera b = read_calibration(shared_data("calibration/pose2sim_qualisys.toml"),
                                      "cam_" + std::string(number));
    EXPECT_EQ(a.width_px, b.width_px);
    EXPECT_EQ(a.height_px, b.height_px);
    for (const Vector3d& point :
         {Vector3d(0, 0, 0), Vector3d(0.3, 0.2, 1), Vector3d(-0.5, 0.4, 1.7)}) {
      const auto in_a = project(a, point), in_b = project(b, point);
      ASSERT_TRUE(in_a && in_b);
      EXPECT_LT((*in_a - *in_b).norm(), 0.01) << number;  // the TOML's vectors are rounded
    }
  }
}

class EasymocapCalibration : public testing::Test {
 protected:
  void write(const std::string& text) {
    const size_t at = text.find("R_01");
    file_ = folder_.write("intri.yml", text.substr(0, at));
    folder_.write("extri.yml", "%YAML:1.0\n---\n" + text.substr(at));
  }
  const TemporaryFolder folder_;
  std::string file_;
};

TEST_F(EasymocapCalibration, IsReadFromItsTwoFiles) {
  write(calibration_corpus("easymocap/pair.yml"));
  EXPECT_THAT(calibration_names(file_), ElementsAre("01", "02"));
  const Camera first = read_calibration(file_, "01");
  EXPECT_EQ(first.width_px, 1920);
  EXPECT_EQ(first.height_px, 1080);
  EXPECT_EQ(first.focal_px, Vector2d(1100, 1102));
  EXPECT_THAT(distortion_coefficients(first), ElementsAre(-0.1, 0.02, 0.001, -0.001, 0));
  // A quarter turn about x: the camera looks along y, z is up.
  EXPECT_TRUE(first.rotation.row(2).isApprox(Eigen::RowVector3d(0, 1, 0), 1e-9)) << first.rotation;
  EXPECT_EQ(first.translation, Vector3d(0.5, 1.5, 4));
  const Camera second = read_calibration(file_, "02", ImageSize{640, 480});
  EXPECT_EQ(second.width_px, 640);
  EXPECT_TRUE(second.rotation.isApprox(turned(), 1e-12));
}

TEST_F(EasymocapCalibration, NamesWhatIsWrong) {
  const std::string sound = calibration_corpus("easymocap/pair.yml");
  const auto message = [&](const std::string& name) {
    return message_of([&] { read_calibration(file_, name); });
  };
  write(sound);
  EXPECT_THAT(message("02"), AllOf(HasSubstr("intri.yml: W_02: found no image size"),
                                   HasSubstr("--image-size WxH")));
  EXPECT_THAT(message("03"), HasSubstr("found no camera '03', allowed: 01, 02"));
  write(replaced(sound, "T_01", "S_01"));
  EXPECT_THAT(message("01"), HasSubstr("extri.yml"));
  std::filesystem::remove(folder_ / "extri.yml");
  EXPECT_THAT(message("01"), HasSubstr("extri.yml"));
}

TEST(ImportedCalibration, IsTakenByAScene) {
  const TemporaryFolder folder;
  folder.write("rig.qca.txt", calibration_corpus("qualisys/two.xml"));
  folder.write("phone.pickle", calibration_corpus("opencap/protocol4.pickle"));
  folder.write("video.mp4", "");
  const Scene scene =
      read_scene(folder.write("scene.yaml",
                              "cameras:\n"
                              "  - {name: '21002', video: video.mp4, calibration: rig.qca.txt}\n"
                              "  - {name: phone, video: video.mp4, calibration: phone.pickle}\n"));
  ASSERT_EQ(scene.cameras.size(), 2u);
  EXPECT_TRUE(camera_centre(scene.cameras[0].camera).isApprox(Vector3d(4, 0, 1.2), 1e-12));
  EXPECT_EQ(scene.cameras[1].camera.width_px, 720);
}

}  // namespace
}  // namespace walktrack
