// A room as rooms are: two cameras of unequal rates, one of which begins later, and something in
// the way that the scene names. Some seconds of one core.
#include <filesystem>

#include <gtest/gtest.h>

#include "core/job_control.h"
#include "io/files.h"
#include "io/motion_file.h"
#include "io/render_file.h"
#include "io/scene.h"
#include "jobs/render.h"
#include "jobs/track.h"
#include "metrics/joint_error.h"

namespace walktrack {
namespace {

namespace fs = std::filesystem;

// The post stands 2.6 m before the side camera and 1 m from the walker's way: it covers 28 columns
// of the picture, all of its height but for the ground, and half a metre of the way.
constexpr const char* kOptions = R"(
seed: 20
frame_rate: 30
duration: 1.6
walk: {speed: 1.25, start: [-1, 0], phase: 0.2}
initial: true
occluders: [{post: [0, -1, 0.15, 2.2]}]
background_frames: 10
cameras:
  - {name: side, azimuth_deg: -90, distance: 3.6, height: 1.2, focal_px: 240, size: [240, 180]}
  - {name: front, azimuth_deg: -20, distance: 4, height: 1.7, focal_px: 240, size: [240, 180],
     frame_rate: 20, start_frame: 4}
)";
constexpr const char* kPost = "occluders: {side: [[[105, 0], [134, 0], [134, 179], [105, 179]]]}\n";

class UnevenCameras : public testing::Test {
 protected:
  UnevenCameras() { fs::create_directories(folder_); }
  ~UnevenCameras() override { fs::remove_all(folder_); }

  void film() const {
    write_file_atomically(folder_ / "options.yaml", kOptions);
    const RenderFile file = read_render_file(folder_ / "options.yaml");
    RenderJob job;
    job.options = file.options;
    job.walker = file.subject;
    job.output = folder_ / "scene";
    render_scene(job, {});
  }
  void track_past_post() const {
    const std::string scene = read_text_file(folder_ / "scene/scene.yaml", size_t{1} << 20);
    write_file_atomically(folder_ / "scene/named.yaml", scene + kPost);
    TrackJob job;
    job.scene = read_scene(folder_ / "scene/named.yaml");
    ASSERT_EQ(job.scene.cameras[0].occluders.size(), 1u);
    ASSERT_EQ(job.scene.cameras[1].frame_rate.value_or(0), 20);
    job.config.values.tracker.filter.particles = 100;
    job.output = folder_ / "tracked";
    job.overlay = false;
    EXPECT_EQ(track_scene(job, {}).status, TrackStatus::kTracked);
  }

  const fs::path folder_ = fs::temp_directory_path() / "walktrack_uneven_cameras";
};

TEST_F(UnevenCameras, FollowAWalkerPastANamedPost) {
  film();
  track_past_post();
  const JointErrors errors = joint_errors(read_motion(folder_ / "scene/truth.csv"),
                                          read_motion(folder_ / "tracked/joints.csv"));
  EXPECT_GT(errors.filled_share, 0.95);
  // Pictures of 240 px leave 3 to 5 cm; a camera taken 4 frames out of step would add 17 cm.
  EXPECT_LT(errors.absolute.mean, 0.08);
  EXPECT_LT(errors.swapped_share, 0.1);
}

}  // namespace
}  // namespace walktrack
