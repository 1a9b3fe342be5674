// A walk of a person of unknown height. Images are used, because a video encoder does not give the
// same bytes twice.
#include <cmath>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/job_control.h"
#include "io/archive/files.h"
#include "io/scene/render_file.h"
#include "io/scene/scene.h"
#include "io/tables/motion_file.h"
#include "jobs/render/render.h"
#include "jobs/track/track.h"
#include "metrics/joint_error.h"
#include "tests/data_folders.h"
#include "tests/io/sample_files.h"

namespace walktrack {
namespace {

namespace fs = std::filesystem;

constexpr const char* kRenderOptions = R"(
seed: 20
frame_rate: 30
duration: 1.6
images: true
walk: {speed: 1.2, start: [-1, 0], phase: 0.2}
subject: {height: 1.58, mass: 60}
background_frames: 10
cameras:
  - {name: side, azimuth_deg: -90, distance: 3.6, height: 1.2, focal_px: 240, size: [240, 180]}
  - {name: front, azimuth_deg: -20, distance: 4, height: 1.7, focal_px: 240, size: [240, 180]}
)";
constexpr const char* kSubject = "subject: {height: 1.58, mass: 60}";

class UnknownSize : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder;
    write_file_atomically(folder() / "options.yaml", kRenderOptions);
    const RenderFile file = read_render_file(folder() / "options.yaml");
    RenderJob job;
    job.options = file.options;
    job.walker = file.subject;
    job.output = folder() / "scene";
    render_scene(job, {});
  }
  static void TearDownTestSuite() { delete folder_; }
  static fs::path folder() { return folder_->path(); }

  // The scene with these statements on the subject.
  static TrackJob job(const std::string& subject) {
    const std::string scene = read_text_file(folder() / "scene/scene.yaml", size_t{1} << 20);
    write_file_atomically(folder() / "scene/other.yaml", replaced(scene, kSubject, subject));
    TrackJob job;
    job.scene = read_scene(folder() / "scene/other.yaml");
    apply_config_file(job.config, kAnyQuality);
    job.config.values.tracker.filter.particles = 60;
    job.config.values.tracker.start.particles = 40;
    job.output = folder() / "tracked";
    job.overlay = false;
    job.overwrite = true;
    return job;
  }
  // Mean distance of hip and knee over the frames in which both are known, m.
  static double thigh_length(const Motion& motion) {
    double sum = 0;
    int count = 0;
    for (const JointPositions& joints : motion.joints) {
      const double length = (joints[Joint::kLeftHip] - joints[Joint::kLeftKnee]).norm();
      if (std::isnan(length)) continue;
      sum += length;
      ++count;
    }
    return sum / count;
  }
  static nlohmann::json run_json() {
    return nlohmann::json::parse(read_text_file(folder() / "tracked/run.json", size_t{1} << 24));
  }

  static TemporaryFolder* folder_;
};

TemporaryFolder* UnknownSize::folder_ = nullptr;

TEST_F(UnknownSize, IsEstimatedFromTheWalkAndStated) {
  EXPECT_EQ(track_scene(job(""), {}).status, TrackStatus::kTracked);
  const nlohmann::json numbers = run_json().at("numbers");
  EXPECT_NEAR(numbers.at("estimated_height_m"), 1.58, 0.05);
  EXPECT_LT(numbers.at("estimated_height_sd_m"), 0.1);
  EXPECT_NE(run_json().at("notes").dump().find("does not say how tall"), std::string::npos);
  const Motion truth = read_motion(folder() / "scene/truth.csv");
  const Motion tracked = read_motion(folder() / "tracked/joints.csv");
  EXPECT_LT(joint_errors(truth, tracked).absolute.mean, 0.08);
  EXPECT_NEAR(thigh_length(tracked) / thigh_length(truth), 1, 0.04);
}

TEST_F(UnknownSize, IsEstimatedWithOneCamera) {
  TrackJob alone = job("");
  alone.scene.cameras.resize(1);
  EXPECT_EQ(track_scene(alone, {}).status, TrackStatus::kTracked);
  EXPECT_NEAR(run_json().at("numbers").at("estimated_height_m"), 1.58, 0.05);
}

TEST_F(UnknownSize, IsEstimatedForAGivenStart) {
  TrackJob placed = job("");
  placed.scene.initial = InitialState{0, {-1, 0}, 0, 1.2, {}};
  EXPECT_EQ(track_scene(placed, {}).status, TrackStatus::kTracked);
  EXPECT_NEAR(run_json().at("numbers").at("estimated_height_m"), 1.58, 0.05);
  EXPECT_EQ(run_json().at("numbers").at("first_tracked_frame"), 0);
  // Also if the video ends before the window of the search is full.
  placed.scene.last_frame = 20;
  track_scene(placed, {});
  EXPECT_NEAR(run_json().at("numbers").at("estimated_height_m"), 1.58, 0.08);
  EXPECT_EQ(run_json().at("numbers").at("tracked_frames"), 21);
}

TEST_F(UnknownSize, IsKnownInTheNextVideoOfThePerson) {
  track_scene(job("subject: {mass: 60}"), {});
  const nlohmann::json first = run_json().at("numbers");
  fs::copy_file(folder() / "tracked/subject.yaml", folder() / "scene/anna.yaml");
  const TrackJob next = job("subject: anna.yaml");
  EXPECT_EQ(next.scene.subject.mass, 60);
  EXPECT_NEAR(next.scene.subject.height, first.at("estimated_height_m"), 0.0006);
  EXPECT_FALSE(next.scene.height_given);
  EXPECT_EQ(track_scene(next, {}).status, TrackStatus::kTracked);
  const nlohmann::json second = run_json().at("numbers");
  EXPECT_NEAR(second.at("estimated_height_m"), 1.58, 0.05);
  // Such small pictures add no evidence; the file has whole millimetres.
  EXPECT_NEAR(second.at("estimated_height_sd_m"), first.at("estimated_height_sd_m"), 0.0006);
  EXPECT_NE(run_json().dump().find("anna.yaml"), std::string::npos);  // among the inputs
  // Somebody who was measured stays that tall.
  track_scene(job("subject: {height: 1.64, height_sd: 0.005}"), {});
  EXPECT_NEAR(run_json().at("numbers").at("estimated_height_m"), 1.64, 0.005);
}

TEST_F(UnknownSize, IsNotEstimatedIfItIsStated) {
  track_scene(job("subject: {height: 1.58}"), {});
  EXPECT_FALSE(fs::exists(folder() / "tracked/subject.yaml"));
  EXPECT_FALSE(run_json().at("numbers").contains("estimated_height_m"));
  EXPECT_EQ(run_json().at("notes").size(), 0u);
}

// A figure of 1.74 m with the legs of the subject, who is 16 cm shorter: their shoulders are 4.6 cm
// lower than its own, and their head is 7.5 cm lower.
TEST_F(UnknownSize, OfTheTrunkIsEstimatedWithOneCameraAndStated) {
  constexpr const char* kLegs =
      "lengths: {thigh: 0.387, shank: 0.389, ankle_height: 0.062, hip_width: 0.158}}";
  const std::string subject = std::string("subject: {height: 1.74, ") + kLegs;
  TrackJob alone = job(subject);
  alone.scene.cameras.resize(1);
  EXPECT_EQ(track_scene(alone, {}).status, TrackStatus::kTracked);
  const double trunk = run_json().at("numbers").at("estimated_trunk_m");
  EXPECT_NEAR(trunk, 0.288 * 1.74 - 0.06, 0.02);
  EXPECT_NE(run_json().at("notes").dump().find("cm less above the hips"), std::string::npos);
  EXPECT_EQ(run_json().at("constants").at(0).at("name"), "trunk_m");
  // The next video of the person has it, which is then stated.
  fs::copy_file(folder() / "tracked/subject.yaml", folder() / "scene/short.yaml");
  TrackJob next = job("subject: short.yaml");
  next.scene.cameras.resize(1);
  ASSERT_TRUE(next.scene.subject.lengths.trunk);
  EXPECT_NEAR(*next.scene.subject.lengths.trunk, trunk, 1e-4);
  EXPECT_NEAR(*next.scene.subject.lengths.thigh, 0.387, 1e-9);
  track_scene(next, {});
  EXPECT_FALSE(run_json().at("numbers").contains("estimated_trunk_m"));
  track_scene(job(subject), {});
  EXPECT_FALSE(run_json().at("numbers").contains("estimated_trunk_m")) << "two cameras";
}

TEST_F(UnknownSize, ThreadsDoNotMatter) {
  std::string digest;
  for (const int threads : {1, 3}) {
    TrackJob each = job("");
    each.config.values.threads = threads;
    track_scene(each, {});
    const std::string found = run_json().at("digest");
    EXPECT_EQ(digest.empty() ? found : digest, found);
    digest = found;
  }
}

}  // namespace
}  // namespace walktrack
