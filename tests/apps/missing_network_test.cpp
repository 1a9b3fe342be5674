// A program that was copied without its network reports that.
#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/data_folders.h"
#include "tests/run_program.h"

namespace walktrack {
namespace {

namespace fs = std::filesystem;

TEST(MissingNetwork, IsReportedWhereItWouldBeUsed) {
  const TemporaryFolder folder;
  const std::string program = folder / "walktrack", demo = kDemo.string();
  fs::copy_file(WALKTRACK_BINARY, program);
  const std::string side = "  - {name: side, video: " + demo + "/side.mp4, calibration: " + demo +
                           "/side.yaml, background: " + demo + "/side_background.mp4}\n",
                    front = "  - {name: front, video: " + demo +
                            "/front.mp4, calibration: " + demo +
                            "/front.yaml, background: " + demo + "/front_background.mp4}\n",
                    head = "subject: {height: 1.75, mass: 70}\nlast_frame: 3\ncameras:\n";
  const auto said = [&](const std::string& name, const std::string& scene,
                        std::vector<std::string> more = {}) {
    std::vector<std::string> words{"track", folder.write(name + ".yaml", scene), "-o",
                                   folder / name, "--no-overlay"};
    words.insert(words.end(), more.begin(), more.end());
    run_program(program, words);
    return read_file(folder / (name + "/run.json"));
  };
  const auto missing = testing::HasSubstr("without keypoints: the network");
  EXPECT_THAT(said("one", head + side), missing);
  EXPECT_THAT(said("two", head + side + front), testing::Not(missing)) << "two cameras do without";
  EXPECT_THAT(said("off", head + side, {"--set", "observation.keypoints.enabled=off"}),
              testing::Not(missing));
}

}  // namespace
}  // namespace walktrack
