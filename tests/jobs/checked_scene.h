// A sound scene for the tests of `walktrack check`, to which each adds one fault.
#pragma once

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "io/calibration/formats/opencv.h"
#include "jobs/check/check.h"
#include "tests/camera/made_camera.h"
#include "tests/io/sample_files.h"
#include "tests/io/sample_video.h"

namespace walktrack {

// 64 x 48 px, at `centre`, looking at the middle of the room.
inline Camera room_camera(const Eigen::Vector3d& centre) {
  return looking_at(lens({64, 48}, {60, 60}, {31.5, 23.5}), centre, {0, 0, 0.9});
}

// Three cameras about a room and their videos, then one fault.
class CheckTest : public testing::Test {
 protected:
  CheckTest() {
    const std::vector<Eigen::Vector3d> centres{{5, -4, 2}, {-5, -3.5, 1.6}, {0.5, 6, 2.4}};
    for (size_t i = 0; i < centres.size(); ++i) {
      cameras_.push_back(room_camera(centres[i]));
      write_camera(i, cameras_[i]);
      write_sample_video(folder_ / file_name(i, ".mp4"), 30);
    }
  }
  static std::string file_name(size_t i, const std::string& end) {
    return std::string("c").append(std::to_string(i)).append(end);
  }
  void write_camera(size_t i, const Camera& camera) {
    folder_.write(file_name(i, ".yaml"), opencv_from_camera(camera));
  }
  CheckReport check(const std::string& more = "", const std::string& rate = "frame_rate: 25\n") {
    std::string text = rate + subject_;
    text.append(more).append("cameras:\n");
    for (size_t i = 0; i < cameras_.size(); ++i) {
      text.append("  - {name: ").append(file_name(i, ""));
      text.append(", video: ").append(file_name(i, ".mp4"));
      text.append(", calibration: ").append(file_name(i, ".yaml")).append("}\n");
    }
    job_.scene = folder_.write("scene.yaml", text);
    return check_scene(job_, {});
  }
  // The only failure of the report.
  static Finding only_failure(const CheckReport& report) {
    Finding found{"", false, "no failure", ""};
    int count = 0;
    for (const Finding& finding : report.findings) {
      if (!finding.failure) continue;
      found = finding;
      ++count;
    }
    EXPECT_LE(count, 1) << check_text(report);
    return found;
  }
  TemporaryFolder folder_;
  std::vector<Camera> cameras_;
  std::string subject_ = "subject: {height: 1.75}\n";
  CheckJob job_;
};

}  // namespace walktrack
