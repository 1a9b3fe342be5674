#include "jobs/render/render.h"

#include <cmath>
#include <cstring>
#include <filesystem>
#include <map>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "body/kinematics.h"
#include "core/conventions.h"
#include "core/errors.h"
#include "io/archive/files.h"
#include "io/scene/render_file.h"
#include "io/tables/csv.h"
#include "io/tables/motion_file.h"
#include "io/video/scene_video.h"

namespace walktrack {
namespace {

namespace fs = std::filesystem;

// Half a second of a figure that moves along x and swings its legs.
Motion gliding_motion() {
  const Body body = make_body(Subject{}, {.head = true, .arms = true});
  Motion motion;
  for (int i = 0; i <= 15; ++i) {
    const double t = i / 30.0;
    Pose pose;
    pose.root = {1.2 * t, 0, 0.93};
    pose.legs[0].hip_flexion = 0.4 * std::sin(6 * t);
    pose.legs[1].hip_flexion = -pose.legs[0].hip_flexion;
    pose.legs[1].knee_flexion = 0.4;
    motion.time.push_back(t);
    motion.joints.push_back(forward_kinematics(body, pose).joints);
  }
  return motion;
}

class Render : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) /
              testing::UnitTest::GetInstance()->current_test_info()->name();
    fs::remove_all(folder_);
    job_.walker.motion = gliding_motion();
    job_.output = folder_ / "scene";
    job_.options.setting = Setting::kStudio;
    job_.options.background_frames = 3;
    RenderCamera small;
    small.name = "side";
    small.width_px = 160;
    small.height_px = 120;
    job_.options.cameras = {small};
  }
  void TearDown() override { fs::remove_all(folder_); }

  static std::string content(const fs::path& file) { return read_text_file(file, 1u << 26); }

  fs::path folder_;
  RenderJob job_;
};

TEST_F(Render, WritesASceneThatReadsBackWithItsTruth) {
  job_.options.state_initial = true;
  RenderCamera late = job_.options.cameras[0];
  late.name = "late";
  late.start_frame = 2;
  late.frame_rate = 60;
  late.distortion = {-0.1, 0.01, 0, 0};
  job_.options.cameras.push_back(late);
  EXPECT_EQ(render_scene(job_, {}), 16u + 31u + 2u);
  const Scene scene = read_scene(job_.output / "scene.yaml");
  ASSERT_EQ(scene.cameras.size(), 2u);
  EXPECT_EQ(scene.cameras[1].start_frame, 2);
  EXPECT_EQ(scene.cameras[1].frame_rate, 60);
  EXPECT_NEAR(scene.cameras[1].camera.distortion[0], -0.1, 1e-9);
  ASSERT_TRUE(scene.initial.has_value());
  EXPECT_NEAR(*scene.initial->speed, 1.2, 0.01);
  const Motion truth = read_motion(scene.truth);
  ASSERT_EQ(truth.time.size(), 16u);
  for (size_t i = 0; i < truth.time.size(); ++i)
    EXPECT_TRUE(truth.joints[i][Joint::kLeftKnee].isApprox(
        job_.walker.motion.joints[i][Joint::kLeftKnee], 1e-5));
  SceneVideo video(scene);
  SceneFrames frames;
  int count = 0;
  while (video.read(frames)) ++count;
  EXPECT_EQ(count, 16);
  EXPECT_EQ(FrameSource(scene.cameras[0].background).facts().frame_count, 3);
  const CsvTable angles = read_csv(job_.output / "angles.csv");
  EXPECT_EQ(angles.rows.size(), 16u);
  // The names are those in a track's result (io/tables/angles_file.h), so that both can be
  // compared.
  EXPECT_TRUE(angles.optional_number(angles.rows[0], angles.column("knee_angle_l_deg")));
  EXPECT_EQ(read_csv(job_.output / "events.csv").columns.size(), 3u);
}

// For all files except videos: the H.264 encoder itself does not promise equal bytes. Their frames
// are keyed by seed, camera and frame (tests/synth/view_test.cpp).
TEST_F(Render, SameSeedSameBytesForAnyThreadCount) {
  job_.options.flow = job_.options.depth = job_.options.labels = true;
  job_.options.duration = 0.2;
  job_.overwrite = true;
  std::map<std::string, std::string> first;
  for (const int threads : {1, 2, 8}) {
    job_.threads = threads;
    render_scene(job_, {});
    for (const char* name : {"side.yaml", "truth.csv", "angles.csv", "tables.json", "events.csv",
                             "labels/side/000003.png", "flow/side/000003.flo",
                             "depth/side/000003.pfm", "scene.yaml"}) {
      const std::string bytes = content(job_.output / name);
      if (threads == 1) first[name] = bytes;
      EXPECT_TRUE(bytes == first[name]) << name << " with " << threads << " threads";
    }
  }
}

TEST_F(Render, ImagesAreTheFramesToTheLastBit) {
  job_.options.images = true;
  job_.threads = 1;
  render_scene(job_, {});
  const std::string once = content(job_.output / "side/000015.png");
  EXPECT_FALSE(fs::exists(job_.output / "side/000016.png"));
  const Scene scene = read_scene(job_.output / "scene.yaml");
  SceneVideo video(scene);
  SceneFrames frames;
  int count = 0;
  while (video.read(frames)) ++count;
  EXPECT_EQ(count, 16);
  // Shorter and with other threads: the same images, and none of the old ones is left.
  job_.threads = 3;
  job_.overwrite = true;
  render_scene(job_, {});
  EXPECT_EQ(content(job_.output / "side/000015.png"), once);
  job_.options.duration = 0.2;
  render_scene(job_, {});
  EXPECT_TRUE(fs::exists(job_.output / "side/000006.png"));
  EXPECT_FALSE(fs::exists(job_.output / "side/000007.png"));
}

// Three cameras in one place, images without noise.
TEST_F(Render, CamerasFilmWhenTheyAreToldTo) {
  job_.options.images = true;
  job_.options.sensor.noise = 0;
  job_.options.start = 0.1;  // the motion extends beyond the scene
  job_.options.duration = 0.2;
  RenderCamera early = job_.options.cameras[0], late = early;
  early.name = "early";
  early.start_frame = 2;
  late.name = "late";
  late.delay = 1 / 30.0;
  job_.options.cameras.push_back(early);
  job_.options.cameras.push_back(late);
  render_scene(job_, {});
  const auto picture = [&](const char* camera, int frame) {
    const fs::path file =
        job_.output / camera / (std::string("00000") + char('0' + frame) + ".png");
    return content(file);
  };
  EXPECT_NE(picture("side", 2), picture("side", 3));
  // For `early` the scene states that its frame 2 is the first, for `late` it states nothing.
  for (int i = 0; i <= 6; ++i) EXPECT_EQ(picture("early", i + 2), picture("side", i)) << i;
  for (int i = 0; i < 6; ++i) EXPECT_EQ(picture("late", i), picture("side", i + 1)) << i;
  const Scene scene = read_scene(job_.output / "scene.yaml");
  EXPECT_EQ(scene.cameras[1].start_frame, 2);
  EXPECT_EQ(scene.cameras[2].start_frame, 0);
}

TEST_F(Render, FiveAndTwoHundredFortyFramesASecond) {
  for (const double rate : {5.0, 240.0}) {
    job_.options.frame_rate = rate;
    job_.options.cameras[0].width_px = 32;
    job_.options.cameras[0].height_px = 24;
    job_.overwrite = true;
    const auto frames = static_cast<size_t>(std::floor(0.5 * rate)) + 1;
    EXPECT_EQ(render_scene(job_, {}), frames);
    const Motion truth = read_motion(job_.output / "truth.csv");
    ASSERT_EQ(truth.time.size(), frames);
    EXPECT_NEAR(truth.time[1], 1 / rate, 1e-6);
    const Scene scene = read_scene(job_.output / "scene.yaml");
    EXPECT_EQ(scene.frame_rate, rate);
    EXPECT_NEAR(FrameSource(scene.cameras[0].video).facts().frame_rate, rate, 1e-3 * rate);
  }
}

TEST_F(Render, AStrongerCodecLosesMore) {
  job_.options.images = true;
  job_.options.duration = 0;
  job_.overwrite = true;
  const auto video = [&](int quality) {
    job_.options.jpeg_quality = quality;
    render_scene(job_, {});
    return cv::imread((job_.output / "side/000000.png").string());
  };
  const cv::Mat exact = video(0);
  const double fine = cv::norm(exact, video(95)), coarse = cv::norm(exact, video(10));
  EXPECT_GT(fine, 0);
  EXPECT_GT(coarse, 1.5 * fine);
}

TEST_F(Render, TheBackgroundIsTheSceneWithoutAnybody) {
  job_.options.images = true;
  job_.options.sensor.noise = 0;
  job_.walker.delay = 0.2;
  render_scene(job_, {});
  const std::string background = content(job_.output / "side_background/000002.png");
  EXPECT_EQ(content(job_.output / "side/000005.png"), background);  // the person is not there yet
  EXPECT_NE(content(job_.output / "side/000006.png"), background);
}

TEST_F(Render, LabelsShowThePartsAndTheFlowMovesWithThem) {
  job_.options.flow = job_.options.labels = true;
  render_scene(job_, {});
  const cv::Mat labels =
      cv::imread((job_.output / "labels/side/000005.png").string(), cv::IMREAD_UNCHANGED);
  ASSERT_EQ(labels.size(), cv::Size(160, 120));
  const std::string flow = content(job_.output / "flow/side/000005.flo");
  ASSERT_EQ(flow.size(), 12 + 160u * 120u * 8u);
  int walker = 0, forward = 0;
  for (int y = 0; y < labels.rows; ++y) {
    for (int x = 0; x < labels.cols; ++x) {
      float u = 0;
      std::memcpy(&u, flow.data() + 12 + 8 * (size_t(y) * 160 + size_t(x)), sizeof u);
      if (labels.at<uint8_t>(y, x) == 0) {
        EXPECT_EQ(u, 0);
        continue;
      }
      ++walker;
      forward += u > 0;  // the camera sees the right side of a walk along +x
    }
  }
  EXPECT_GT(walker, 200);
  EXPECT_GT(forward, 0.9 * walker);
}

TEST_F(Render, ACompleteSceneIsNotOverwrittenUnasked) {
  render_scene(job_, {});
  EXPECT_THROW(render_scene(job_, {}), UsageError);
  job_.overwrite = true;
  EXPECT_NO_THROW(render_scene(job_, {}));
}

// A child's joints without a stated height.
TEST_F(Render, TheSubjectIsAsTallAsItsLegsUnlessStated) {
  for (JointPositions& joints : job_.walker.motion.joints)
    for (Eigen::Vector3d& joint : joints.at) joint *= 0.8;
  job_.options.duration = 0.1;
  render_scene(job_, {});
  EXPECT_NEAR(read_scene(job_.output / "scene.yaml").subject.height, 0.8 * 1.75, 1e-3);
  job_.walker.height = 1.6;
  job_.overwrite = true;
  render_scene(job_, {});
  EXPECT_EQ(read_scene(job_.output / "scene.yaml").subject.height, 1.6);
}

TEST_F(Render, AWalkerWhoIsNotThereAllTheTimeIsUnknownThen) {
  job_.walker.delay = 0.2;
  job_.options.duration = 0.5;
  render_scene(job_, {});
  const Motion truth = read_motion(job_.output / "truth.csv");
  EXPECT_FALSE(known(truth.joints[5][Joint::kPelvis]));
  EXPECT_TRUE(known(truth.joints[6][Joint::kPelvis]));
}

TEST_F(Render, AGaitComesWithItsForcesInTheScenesPlaceAndTime) {
  job_.gait = GaitWalk{.plan = {.speed = 1.2, .changes = {}}};
  job_.walker.motion = {};
  job_.walker.turn = 0.5 * kPi;
  job_.walker.shift = {3, 1};
  job_.options.duration = 0.5;
  job_.overwrite = true;
  render_scene(job_, {});
  const Motion truth = read_motion(job_.output / "truth.csv");
  EXPECT_LT((truth.joints[0][Joint::kPelvis].head<2>() - Eigen::Vector2d(3, 1)).norm(), 1e-4);
  const CsvTable table = read_csv(job_.output / "kinetics.csv");
  ASSERT_EQ(table.rows.size(), truth.time.size());
  for (size_t i = 0; i < truth.time.size(); ++i) {
    const auto cell = [&](const char* name) {
      return table.number(table.rows[i], table.column(name));
    };
    EXPECT_NEAR(cell("t"), truth.time[i], 1e-6);
    // The centre of mass is above the hips, within the range of a leaning trunk.
    EXPECT_NEAR(cell("com_x_m"), truth.joints[i][Joint::kPelvis].x(), 1e-4);
    EXPECT_NEAR(cell("com_y_m"), truth.joints[i][Joint::kPelvis].y(), 0.15);
    EXPECT_NEAR(cell("l_grf_x_n"), 0, 1e-6);  // the walk is along y here
  }
  // Another motion replaces the walk, and the forces are removed.
  job_.gait.reset();
  job_.walker.motion = gliding_motion();
  render_scene(job_, {});
  EXPECT_FALSE(fs::exists(job_.output / "kinetics.csv"));
}

TEST_F(Render, ReadsGaitsAndRefusesWhatTheyAreNot) {
  fs::create_directories(folder_);
  const fs::path file = folder_ / "options.yaml";
  write_file_atomically(file,
                        "gait: {speed: 1.1, step_length: 0.6, start: [1, 2], heading_deg: 90, "
                        "speed_at: [[1, 1.4], [3, 0.9]]}\n");
  const RenderFile read = read_render_file(file);
  ASSERT_TRUE(read.gait);
  EXPECT_EQ(read.gait->plan.speed, 1.1);
  EXPECT_EQ(read.gait->plan.step_length, 0.6);
  EXPECT_EQ(read.gait->start.y(), 2);
  EXPECT_NEAR(read.gait->heading, 0.5 * kPi, 1e-12);
  ASSERT_EQ(read.gait->plan.changes.size(), 2u);
  EXPECT_EQ(read.gait->plan.changes[1].speed, 0.9);
  for (const char* text :
       {"gait: {pace: 1}\n", "gait: {speed: 1}\nwalk: {speed: 1}\n",
        "gait: {speed_at: [[3, 1], [1, 1]]}\n", "gait: {speed_at: [[1, 0]]}\n"}) {
    write_file_atomically(file, text);
    EXPECT_THROW(read_render_file(file), InputError) << text;
  }
}

TEST_F(Render, ReadsEveryOptionAndRefusesUnknownOnes) {
  fs::create_directories(folder_);
  const fs::path file = folder_ / "options.yaml";
  write_file_atomically(folder_ / "other.csv", motion_csv(gliding_motion()));
  write_file_atomically(file, R"(
seed: 9
frame_rate: 7
start: 0.1
duration: 2.5
setting: field
light: {azimuth_deg: 90, elevation_deg: 30, sun: 0.3, ambient: 0.2, shadows: false}
sensor: {exposure: 0.5, noise: 0.02, flicker: 0.01, monochrome: true, blur_samples: 4, shutter: 0.8,
         jpeg_quality: 40}
background_frames: 0
subject: {height: 1.6, mass: 55, clothes: 2, arms: false, shift: [1, 2], turn_deg: 90, delay: 0.3}
cameras:
  - {name: a, size: [320, 240], focal_px: 300, distortion: [0.1, 0.01, 0, 0], azimuth_deg: 45,
     distance: 4, height: 2, frame_rate: 25, start_frame: 3, delay: 0.01}
  - {name: b, position: [0, -5, 1], look_at: [0, 0, 1]}
occluders: [{post: [1, -1, 0.2, 2]}, {box: [0, 0, 0, 1, 1, 1]}]
others: [{motion: other.csv, shift: [0, 1.5], clothes: 3, height: 1.8}]
slope_deg: 3
initial: true
truth: {labels: true, flow: true, depth: true}
)");
  const RenderFile read = read_render_file(file);
  EXPECT_EQ(read.options.seed, 9u);
  EXPECT_EQ(read.options.setting, Setting::kField);
  EXPECT_FALSE(read.options.light.shadows);
  EXPECT_NEAR(read.options.light.azimuth, 1.5708, 1e-4);
  EXPECT_EQ(read.options.shutter.blur_samples, 4);
  EXPECT_TRUE(read.options.sensor.monochrome);
  EXPECT_EQ(read.options.jpeg_quality, 40);
  EXPECT_EQ(read.options.cameras[0].width_px, 320);
  EXPECT_EQ(read.options.cameras[0].start_frame, 3);
  EXPECT_EQ(read.options.cameras[1].position->y(), -5);
  EXPECT_EQ(read.options.occluders.size(), 2u);
  EXPECT_EQ(read.options.others[0].motion.time.size(), 16u);
  EXPECT_FALSE(read.subject.arms);
  EXPECT_EQ(read.subject.shift.y(), 2);
  EXPECT_TRUE(read.options.state_initial && read.options.flow);
  write_file_atomically(file, "sensor: {nose: 0.1}\n");
  try {
    read_render_file(file);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("noise"), std::string::npos) << error.what();
  }
  write_file_atomically(file, "setting: kitchen\n");
  EXPECT_THROW(read_render_file(file), InputError);
  write_file_atomically(file, "frame_rate: 0\n");
  EXPECT_THROW(read_render_file(file), InputError);
}

}  // namespace
}  // namespace walktrack
