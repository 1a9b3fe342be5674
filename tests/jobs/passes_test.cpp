// Somebody who walks through the picture, turns around out of sight, and walks back, as on a
// walkway. Images are used, because a video encoder does not give the same bytes twice.
#include <filesystem>
#include <string>
#include <utility>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/job_control.h"
#include "io/archive/files.h"
#include "io/scene/render_file.h"
#include "io/scene/scene.h"
#include "io/tables/motion_file.h"
#include "jobs/render/render.h"
#include "jobs/track/track.h"
#include "tests/data_folders.h"
#include "tests/io/sample_files.h"

namespace walktrack {
namespace {

namespace fs = std::filesystem;

// Each camera sees 1.6 m of the walkway on either side of its middle, which the subject passes
// after 1.8 s.
constexpr const char* kPassOptions = R"(
seed: 23
frame_rate: 30
duration: 3.6
images: true
walk: {speed: 1.4, start: [-2.52, 0], phase: 0.2}
background_frames: 10
cameras:
  - {name: near, azimuth_deg: -90, distance: 2.8, height: 1, focal_px: 210, size: [240, 180]}
  - {name: far, azimuth_deg: 90, distance: 2.8, height: 1.1, focal_px: 210, size: [240, 180]}
)";
constexpr int kPass = 108;  // frames

// The motion, and the same once more from where it ends, the other way.
Motion there_and_back(Motion motion) {
  const Motion once = motion;
  const double seconds = once.time.back() - once.time.front() + sample_period(once);
  for (size_t i = 0; i < once.time.size(); ++i) {
    motion.time.push_back(once.time[i] + seconds);
    JointPositions joints = once.joints[i];
    for (Eigen::Vector3d& joint : joints.at) joint.head<2>() *= -1;
    motion.joints.push_back(joints);
  }
  return motion;
}

class Passes : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder;
    write_file_atomically(folder() / "options.yaml", kPassOptions);
    const RenderFile file = read_render_file(folder() / "options.yaml");
    RenderJob job;
    job.options = file.options;
    job.options.duration = 2 * *job.options.duration;
    job.walker = file.subject;
    job.walker.motion = there_and_back(std::move(job.walker.motion));
    job.output = folder() / "scene";
    render_scene(job, {});
    const std::string scene = read_text_file(folder() / "scene/scene.yaml", size_t{1} << 20);
    const size_t far = scene.find("  - {name: far"), end = scene.find('\n', far) + 1;
    write_file_atomically(folder() / "scene/one.yaml", scene.substr(0, far) + scene.substr(end));
  }
  static void TearDownTestSuite() { delete folder_; }
  static fs::path folder() { return folder_->path(); }

  // Expects that of the frames in which the whole person is in the picture nearly all are tracked,
  // to `most` m of the pelvis, and that the time out of the picture is not held against the track.
  static void expect_both_passes(const std::string& scene, double most) {
    TrackJob job;
    job.scene = read_scene(folder() / "scene" / scene);
    job.config.values.tracker.filter.particles = 80;
    job.config.values.tracker.start.particles = 60;
    job.output = folder() / ("tracked_" + scene);
    job.overlay = false;
    track_scene(job, {});
    const Motion truth = read_motion(folder() / "scene/truth.csv"),
                 found = read_motion(job.output / "joints.csv");
    const auto pelvis = size_t(Joint::kPelvis);
    int seen[2] = {0, 0}, tracked[2] = {0, 0};
    for (size_t i = 0; i < found.joints.size(); ++i) {
      const Eigen::Vector3d at = truth.joints[i].at[pelvis], estimate = found.joints[i].at[pelvis];
      if (std::abs(at.x()) > 1.2) continue;
      const int pass = i < kPass ? 0 : 1;
      ++seen[pass];
      if (known(estimate) && (at - estimate).norm() < most) ++tracked[pass];
    }
    for (const int pass : {0, 1}) EXPECT_GE(tracked[pass], 0.9 * seen[pass]) << scene << pass;
    const auto run =
        nlohmann::json::parse(read_text_file(job.output / "run.json", size_t{1} << 24));
    EXPECT_GT(run.at("numbers").at("out_of_picture_frames"), 5);
    const auto gait =
        nlohmann::json::parse(read_text_file(job.output / "gait.json", size_t{1} << 24));
    const nlohmann::json& width = gait.at("summary").at("both").at("step_width_m");
    EXPECT_LT(width.at("p95").get<double>(), 0.6) << "the error is that of the middle of a pass";
    for (const nlohmann::json& check : run.at("quality")) {
      if (check.at("name") == "lost_percent") {
        EXPECT_TRUE(check.at("passed")) << check;
      }
    }
  }

  static TemporaryFolder* folder_;
};

TemporaryFolder* Passes::folder_ = nullptr;

TEST_F(Passes, AreTrackedBeforeOneCamera) { expect_both_passes("one.yaml", 0.25); }

// A figure behind one of them is seen by the other alone.
TEST_F(Passes, AreTrackedBetweenCamerasThatFaceEachOther) { expect_both_passes("scene.yaml", 0.1); }

}  // namespace
}  // namespace walktrack
