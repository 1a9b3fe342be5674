// Left and right in front of one camera, which silhouettes from the side do not determine.
#include "tracker/start/leg_label_evidence.h"

#include <filesystem>

#include <gtest/gtest.h>

#include "body/kinematics.h"
#include "body/pose_from_joints.h"
#include "io/scene/render_file.h"
#include "io/tables/motion_file.h"
#include "jobs/render/render.h"
#include "jobs/track/track.h"
#include "metrics/joint_error.h"
#include "synth/recording/stage.h"
#include "synth/walk/made_walk.h"
#include "tests/run_program.h"
#include "tests/synth/filmed.h"
#include "tracker/moves/mirror_legs.h"

namespace walktrack {
namespace {

namespace fs = std::filesystem;

constexpr double kInterval = 1.0 / 30;  // s
constexpr uint32_t kPictures = 36;

// A stride of a person with arms, recorded from one side, in which everything looks like the
// walker.
struct Video {
  explicit Video(double azimuth_deg) {
    MadeWalk walk;
    walk.to = 2;
    walk.rate = 30;
    walk.start = {-1, 0};
    FilmedWalker walker;
    walker.motion = made_walk(make_body(Subject{}, {.head = true, .arms = true}), walk);
    RenderOptions options;
    options.cameras = {small_camera(azimuth_deg, 2)};
    const Stage stage = make_stage(walker, options, {});
    scene.cameras = stage.cameras;
    scene.model.body = make_body(Subject{}, {});
    const View view = make_view(stage.world, stage.cameras[0], 2);
    for (uint32_t i = 0; i < kPictures; ++i) {
      window.push_back({evidence(stage, view, i)});
      FrameRecord record;
      record.tracked = true;
      record.estimate.pose = *pose_from_joints(walker.motion.joints[i], scene.model.body.lengths);
      truth.push_back(record);
    }
  }

  static CameraEvidence evidence(const Stage& stage, const View& view, uint32_t frame) {
    CameraEvidence out;
    out.picture = {view.camera.width_px, view.camera.height_px,
                   grey_picture(stage, view, frame, frame * kInterval)};
    resize(out.planes, {0, 0, view.camera.width_px, view.camera.height_px}, 1);
    for (int y = 0; y < view.camera.height_px; ++y)
      set_row(out.planes, 0, y, std::vector<float>(size_t(view.camera.width_px), 1.0F), 4);
    return out;
  }

  std::vector<FrameRecord> swapped() const {
    std::vector<FrameRecord> records = truth;
    for (FrameRecord& record : records) mirror_legs(scene.model.body, record);
    return records;
  }

  TrackerScene scene;
  std::deque<SceneEvidence> window;
  std::vector<FrameRecord> truth;
};

TEST(LegNames, AreToldFromEitherSide) {
  for (const double azimuth_deg : {-90.0, 90.0}) {
    const Video video(azimuth_deg);
    EXPECT_GT(legs_log_odds(video.scene, video.window, video.truth), 0.5) << azimuth_deg;
    EXPECT_LT(legs_log_odds(video.scene, video.window, video.swapped()), -0.5) << azimuth_deg;
  }
}

TEST(LegNames, AreUnknownWithoutPicturesOrTracks) {
  Video video(-90);
  std::vector<FrameRecord> lost = video.truth;
  for (FrameRecord& record : lost) record.tracked = false;
  EXPECT_EQ(legs_log_odds(video.scene, video.window, lost), 0);
  EXPECT_EQ(legs_log_odds(video.scene, video.window, {}), 0);
  for (SceneEvidence& each : video.window) each[0].picture = {};
  EXPECT_EQ(legs_log_odds(video.scene, video.window, video.truth), 0);
}

// In black trousers, which do not show which leg is in front.
constexpr const char* kBlackTrousers = R"(
seed: 1
frame_rate: 30
duration: 3.6
images: true
walk: {speed: 0.8, start: [-1.44, 0.2], heading_deg: -8}
subject: {height: 1.58, mass: 70, clothes: 0}
sensor: {noise: 0.008, flicker: 0.005}
background_frames: 15
cameras:
  - {name: side, azimuth_deg: -90, distance: 5.6, height: 1.2, focal_px: 240, size: [248, 186]}
)";

// Particles that swap the legs while they pass each other are corrected: with one of these seeds
// the legs were swapped in 29 % of the frames.
TEST(LegNames, StayCorrectWhileTheLegsPass) {
  const TemporaryFolder folder;
  const RenderFile file = read_render_file(folder.write("options.yaml", kBlackTrousers));
  RenderJob video;
  video.options = file.options;
  video.walker = file.subject;
  video.output = folder / "scene";
  render_scene(video, {});
  const Motion truth = read_motion(folder / "scene/truth.csv");
  TrackJob job;
  job.scene = read_scene(folder / "scene/scene.yaml");
  job.config.values.tracker.filter.particles = 60;
  job.output = folder / "tracked";
  job.overlay = false;
  job.overwrite = true;
  for (const uint64_t seed : {1, 2, 3}) {
    job.config.values.seed = seed;
    track_scene(job, {});
    EXPECT_LT(joint_errors(truth, read_motion(folder / "tracked/joints.csv")).swapped_share, 0.05)
        << seed;
  }
}

// A real walk past one camera that begins with standing: with this seed outlines label the legs
// wrongly at first, and both feet were 0.4 m from their places.
TEST(LegNames, OfARealWalkAreThoseOfTheNearLeg) {
  const fs::path data = fs::path(WALKTRACK_SOURCE_DIR) / "../shared/data/sports2d_side";
  if (!fs::exists(data / "scene.yaml")) GTEST_SKIP() << "no " << data;
  const TemporaryFolder folder;
  TrackJob job;
  job.scene = read_scene(data / "scene.yaml");
  job.scene.last_frame = 74;
  job.output = folder / "tracked";
  job.overlay = false;
  job.overwrite = true;
  job.config.values.seed = 7;
  track_scene(job, {});
  const Motion motion = read_motion(folder / "tracked/joints.csv");
  const auto foot = [&](Side side, size_t frame) {
    const JointPositions& joints = motion.joints.at(frame);
    return 0.5 * (joints[ankle(side)] + joints[toe(side)]).x();
  };
  // Foot plants that were supplied with the clip: frames 23 to 49, 42 to 68, 62 to 83.
  EXPECT_NEAR(foot(Side::kRight, 38), -5.208, 0.15);
  EXPECT_NEAR(foot(Side::kLeft, 52), -4.478, 0.15);
  EXPECT_NEAR(foot(Side::kLeft, 62), -4.478, 0.15);
  EXPECT_NEAR(foot(Side::kRight, 72), -3.742, 0.15);
}

// Two cameras before and behind the subject, on one side: with these seeds the half second in which
// a start is decided labelled the legs wrongly, and 57 % of the frames of the video had swapped
// legs.
TEST(LegNames, OfTwoCamerasAreThoseThatExplainTheWholeWindow) {
  const fs::path data = fs::path(WALKTRACK_SOURCE_DIR) / "../shared/data/rendered/cmu_02_02";
  if (!fs::exists(data / "scene.yaml")) GTEST_SKIP() << "no " << data;
  const TemporaryFolder folder;
  const Motion truth = read_motion(data / "truth.csv");
  TrackJob job;
  job.scene = read_scene(data / "scene.yaml");
  job.scene.cameras.erase(job.scene.cameras.begin());
  job.scene.last_frame = 50;
  job.output = folder / "tracked";
  job.overlay = false;
  job.overwrite = true;
  for (const uint64_t seed : {3, 4}) {
    job.config.values.seed = seed;
    track_scene(job, {});
    EXPECT_LT(joint_errors(truth, read_motion(folder / "tracked/joints.csv")).swapped_share, 0.05)
        << seed;
  }
}

}  // namespace
}  // namespace walktrack
