// Calibrations of other tools are converted to files that scenes read as the same cameras.
#include "jobs/calibrate/import_calibration.h"

#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/Core>

#include "core/errors.h"
#include "io/calibration/formats/opencv.h"
#include "tests/message_of.h"
#include "tests/run_program.h"

namespace walktrack {
namespace {

namespace fs = std::filesystem;

using testing::HasSubstr;

fs::path corpus(const std::string& name) {
  return fs::path(WALKTRACK_SOURCE_DIR) / "tests/fuzz/corpus" / ("calibration_" + name);
}

class ImportCalibration : public testing::Test {
 protected:
  ImportJob job(const std::string& file) {
    return {.file = file, .output = folder_ / "out", .command_line = {"walktrack"}};
  }
  // A copy with the ending by which the format is recognised.
  std::string qualisys() {
    fs::copy_file(corpus("qualisys/two.xml"), folder_ / "rig.qca.txt",
                  fs::copy_options::overwrite_existing);
    return folder_ / "rig.qca.txt";
  }
  const TemporaryFolder folder_;
};

TEST_F(ImportCalibration, WritesEveryCameraOfAFile) {
  const ImportOutcome outcome = import_calibration(job(qualisys()));
  ASSERT_EQ(outcome.cameras.size(), 2u);
  EXPECT_TRUE(outcome.notes.empty()) << outcome.notes[0];
  for (const auto& [name, camera] : outcome.cameras) {
    const Camera yaml = read_calibration(folder_ / ("out/" + name + ".yaml"), name);
    EXPECT_EQ(yaml.rotation, camera.rotation);
    EXPECT_EQ(yaml.translation, camera.translation);
    EXPECT_EQ(yaml.distortion, camera.distortion);
    const Camera toml = read_calibration(folder_ / "out/cameras.toml", name);
    EXPECT_LT((toml.rotation - camera.rotation).norm(), 1e-9);
    EXPECT_EQ(toml.focal_px, camera.focal_px);
  }
  EXPECT_THAT(import_text(outcome), HasSubstr("21001: 1920x1080 px, focal length 1100.0 1102.0 px, "
                                              "at 0.500 -4.000 1.500 m\n"));
  EXPECT_THROW(import_calibration(job(qualisys())), UsageError) << "there is a result already";
}

TEST_F(ImportCalibration, TakesTheOneThatIsAskedFor) {
  ImportJob one = job(qualisys());
  one.name = "21002";
  EXPECT_EQ(import_calibration(one).cameras.size(), 1u);
  EXPECT_TRUE(fs::exists(folder_ / "out/21002.toml"));
  EXPECT_FALSE(fs::exists(folder_ / "out/21001.yaml"));
  one.name = "21009";
  EXPECT_THAT(message_of([&] { import_calibration(one); }), HasSubstr("21001, 21002"));
}

// Each telephone of a session has a file; both are converted into one folder.
TEST_F(ImportCalibration, GathersOneCameraFilesAndSaysWhereUpIs) {
  for (const char* name : {"Cam0", "Cam1"}) {
    ImportJob one = job(corpus("opencap/protocol4.pickle"));
    one.name = name;
    const ImportOutcome outcome = import_calibration(one);
    ASSERT_EQ(outcome.cameras.size(), 1u);
    EXPECT_TRUE(outcome.notes.empty());
  }
  EXPECT_TRUE(fs::exists(folder_ / "out/Cam0.yaml"));
  EXPECT_TRUE(fs::exists(folder_ / "out/Cam1.yaml"));
}

TEST_F(ImportCalibration, SaysWhichWayIsUpWhereItIsNotZ) {
  Camera camera = read_calibration(corpus("opencap/protocol4.pickle"), "cam0");
  // As for a board against a wall: y points down.
  camera.rotation = Eigen::Matrix3d::Identity();
  const std::string file = folder_.write("wall.yaml", opencv_from_camera(camera));
  const ImportOutcome outcome = import_calibration(job(file));
  ASSERT_EQ(outcome.notes.size(), 1u);
  EXPECT_THAT(outcome.notes[0], HasSubstr("ground: {normal: [0, -1, 0], offset: D}"));
  EXPECT_TRUE(fs::exists(folder_ / "out/cam0.yaml"));
}

TEST_F(ImportCalibration, AFilesNamesDoNotLeaveTheFolder) {
  std::string text = read_file(qualisys());
  text.replace(text.find("21001"), 5, "../21");
  const std::string file = folder_.write("bad.qca.txt", text);
  EXPECT_THAT(message_of([&] { import_calibration(job(file)); }),
              HasSubstr("found a camera called '../21'"));
  EXPECT_FALSE(fs::exists(folder_ / "out"));
  text.replace(text.find("../21"), 5, "21002");
  const std::string twice = folder_.write("twice.qca.txt", text);
  EXPECT_THAT(message_of([&] { import_calibration(job(twice)); }), HasSubstr("two cameras called"));
}

}  // namespace
}  // namespace walktrack
