#include "jobs/selftest/selftest_video.h"

#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "body/kinematics.h"
#include "core/errors.h"
#include "io/archive/files.h"
#include "io/calibration/formats/opencv.h"
#include "io/drawing/picture.h"
#include "io/tables/motion_file.h"
#include "jobs/track/track.h"
#include "metrics/joint_error.h"
#include "observation/image.h"
#include "synth/recording/sensor.h"
#include "synth/recording/stage.h"

namespace walktrack {
inline namespace jobs {

namespace fs = std::filesystem;

namespace {

constexpr double kSeconds = 2;      // of a video
constexpr double kHeight = 1.75;    // m, of the walker
constexpr double kLeastMass = 0.5;  // kg, that a scene may state
constexpr double kFarthest = 1000;  // m; no walker gets farther in a self-test
constexpr size_t kMaxJointTableBytes = 64u << 20;
constexpr int kEmptyFrames = 10;
constexpr double kMostMemoryGrowth = 1;  // MB, from the first half of a video to the second
constexpr uint32_t kVideoStream = 0, kBackgroundStream = 1;

struct Shot {
  Frames frames, background;
  Camera camera;
  Motion truth;
};

Image image_of(const Plane<Colour>& light, const TestVideo& video, uint32_t stream, size_t frame) {
  const std::vector<uint8_t> bytes = developed(light, video.options.sensor, video.options.seed,
                                               stream, static_cast<uint32_t>(frame));
  const Image image = bgr_image(bytes, light.width, light.height);
  return video.enlarge == 1 ? image : enlarged(image, video.enlarge);
}

// The camera with pixels of 1 / factor the size.
Camera enlarged(Camera camera, double factor) {
  camera.width_px = static_cast<int>(camera.width_px * factor);
  camera.height_px = static_cast<int>(camera.height_px * factor);
  camera.focal_px *= factor;
  // Pixel centres are at integers.
  camera.centre_px = (camera.centre_px.array() + 0.5) * factor - 0.5;
  return camera;
}

Shot shoot(const TestVideo& video) {
  const Stage stage = make_stage(video.walker, video.options, {std::nullopt});
  const View view = make_view(stage.world, stage.cameras[0], 1);
  Shot shot;
  shot.camera = enlarged(stage.cameras[0], video.enlarge);
  std::vector<double> times;
  for (double time = 0; time <= stage.duration; time += 1 / video.options.frame_rate) {
    const Plane<Colour> light =
        exposed(stage, view, video.options.shutter, time, video.options.frame_rate);
    shot.frames.push_back(image_of(light, video, kVideoStream, times.size()));
    times.push_back(time);
  }
  for (size_t i = 0; i < kEmptyFrames; ++i) {
    shot.background.push_back(image_of(view.empty, video, kBackgroundStream, i));
  }
  shot.truth = truth_at(stage, times);
  if (video.degrade) video.degrade(shot.frames);
  return shot;
}

void write_frames(const Frames& frames, const fs::path& folder) {
  fs::create_directories(folder);
  for (size_t i = 0; i < frames.size(); ++i)
    write_picture(folder / fmt::format("{:06}.bmp", i), frames[i]);
}

// The line `initial` of the scene, from the first half second of the walk.
std::string start_of_walk(const Motion& truth) {
  size_t last = 0;
  while (last + 1 < truth.time.size() && truth.time[last] < 0.5) ++last;
  const Eigen::Vector3d from = truth.joints.front()[Joint::kPelvis];
  const Eigen::Vector3d way = truth.joints[last][Joint::kPelvis] - from;
  const double seconds = std::max(truth.time[last], 1e-3);
  return fmt::format("initial: {{position: [{:.3f}, {:.3f}], heading: {:.3f}, speed: {:.3f}}}\n",
                     from.x(), from.y(), std::atan2(way.y(), way.x()),
                     way.head<2>().norm() / seconds);
}

fs::path write_scene(const TestVideo& video, const Shot& shot, const fs::path& folder) {
  write_frames(shot.frames, folder / "video");
  write_frames(shot.background, folder / "empty");
  write_file_atomically(folder / "camera.yaml", opencv_from_camera(shot.camera));
  std::string text =
      "cameras: [{name: side, video: video, calibration: camera.yaml, background: empty}]\n";
  text += fmt::format("frame_rate: {}\n", video.options.frame_rate);
  text += fmt::format("subject: {{height: {}, mass: {}}}\n", height_of(video.walker),
                      video.walker.mass);
  if (video.state_initial) text += start_of_walk(shot.truth);
  write_file_atomically(folder / "scene.yaml", text + video.scene_lines);
  return folder / "scene.yaml";
}

ConfigWithOrigin config_of(const TestVideo& video) {
  ConfigWithOrigin config;
  // Few particles: trials test for crashes, not accuracy.
  for (const char* setting : {"threads=1", "filter.particles=150", "start.particles=40"}) {
    apply_setting(config, setting, "selftest");
  }
  for (const std::string& setting : video.settings) apply_setting(config, setting, "selftest");
  return config;
}

// MB on the heap; the resident size depends on the kernel as well.
double heap_memory() {
  const struct mallinfo2 heap = mallinfo2();
  return static_cast<double>(heap.uordblks + heap.hblkhd) / (1 << 20);
}

// The least memory that tracking took in each half of the video: what it keeps for good. The most
// depends on how long the subject was searched for, as frames are held while somebody may stand.
struct MemoryWatch {
  double first_half = std::numeric_limits<double>::infinity(), second_half = first_half;  // MB

  void look(const Progress& progress) {
    // Tables are still made in the first frames.
    if (progress.what != "tracking" || 5 * progress.done < progress.total) return;
    double& half = 2 * progress.done <= progress.total ? first_half : second_half;
    half = std::min(half, heap_memory());
  }
  double growth() const { return second_half - first_half; }
};

TrackOutcome track(const fs::path& scene, ConfigWithOrigin config, const fs::path& output,
                   const JobControl& control) {
  TrackJob job;
  job.scene = read_scene(scene);
  job.config = std::move(config);
  job.output = output;
  job.overlay = false;
  job.ignore_checks = true;  // the trials use extreme inputs on purpose
  return track_scene(job, control);
}

// The first fault of a result; empty if it has none. The reader refuses cells that are not numbers.
std::string fault_in(const fs::path& output) {
  const std::string uncertainty = read_text_file(output / "uncertainty.csv", kMaxJointTableBytes);
  if (uncertainty.find("nan", uncertainty.find('\n')) != std::string::npos ||
      uncertainty.find("inf", uncertainty.find('\n')) != std::string::npos) {
    return "uncertainty.csv holds what is no number";
  }
  const Motion motion = read_motion(output / "joints.csv");
  for (size_t i = 0; i < motion.time.size(); ++i) {
    for (const Eigen::Vector3d& joint : motion.joints[i].at) {
      if (known(joint) && joint.norm() > kFarthest) {
        return fmt::format("a joint {:g} m away at {:g} s", joint.norm(), motion.time[i]);
      }
    }
  }
  return {};
}

// Judges an outcome. `height` of the walker, m.
TrialResult judged(const TrackOutcome& outcome, const Motion& truth, double height,
                   const fs::path& output) {
  TrialResult result;
  result.what = fault_in(output);
  if (!result.what.empty()) return result;
  result.what = fmt::format("{} of {} frames", outcome.tracked, outcome.frames);
  result.end = outcome.status == TrackStatus::kTracked ? TrialEnd::kTracked : TrialEnd::kDegraded;
  if (!outcome.message.empty()) result.what += "; " + outcome.message;
  if (outcome.tracked == 0) return result;
  const auto errors = joint_errors(truth, read_motion(output / "joints.csv"));
  const double error = errors.by_joint[static_cast<size_t>(Joint::kPelvis)].absolute.median;
  if (!std::isfinite(error)) return result;
  result.what += fmt::format("; pelvis {:.2f} m off", error);
  if (error > kTrackedWithin * height) result.end = TrialEnd::kDegraded;
  return result;
}

}  // namespace

TestVideo video_of_walk(double speed) {
  TestVideo video;
  video.walker.height = kHeight;
  const Body body = make_body({.height = kHeight, .lengths = {}}, {.arms = true});
  MadeWalk walk;
  walk.speed = speed;
  walk.to = kSeconds;
  video.walker.motion = made_walk(body, walk);
  RenderCamera camera;
  camera.width_px = 160;
  camera.height_px = 120;
  video.options.cameras = {camera};
  return video;
}

TestVideo video_of_body(double height) {
  TestVideo video = video_of_walk();
  const double length = height / kHeight, time = std::sqrt(length);
  video.walker.height = height;
  video.walker.mass = std::max(kLeastMass, video.walker.mass * std::pow(length, 3));
  Motion& motion = video.walker.motion;
  const Eigen::Vector3d middle = 0.5 * length * motion.joints.back()[Joint::kPelvis];
  for (double& each : motion.time) each *= time;
  for (JointPositions& joints : motion.joints) {
    for (Eigen::Vector3d& joint : joints.at) joint *= length;
  }
  RenderCamera& camera = video.options.cameras[0];
  camera.look_at = {middle.x(), middle.y(), 0.5 * height};
  camera.position = *camera.look_at + height * Eigen::Vector3d(0, -2.6, 0.2);
  return video;
}

TestVideo video_of_standing(double speed, double turn_rate) {
  TestVideo video = video_of_walk();
  const Body body = make_body({}, {});
  Motion standing;
  for (double time = 0; time <= kSeconds; time += 0.01) {
    Pose pose;
    pose.root = {speed * time, 0, leg_length(body.lengths)};
    pose.heading = turn_rate * time;
    standing.time.push_back(time);
    standing.joints.push_back(forward_kinematics(body, pose).joints);
    for (int j = kJointCountWithoutArms; j < kJointCount; ++j) {
      standing.joints.back().at[static_cast<size_t>(j)] = unknown_joints().at[0];
    }
  }
  video.walker.motion = std::move(standing);
  video.walker.arms = false;
  return video;
}

TrialResult try_video(const TestVideo& video, const fs::path& folder) {
  ConfigWithOrigin config = config_of(video);  // a setting that is refused is an error of the trial
  try {
    Shot shot = shoot(video);
    const fs::path scene = write_scene(video, shot, folder);
    shot.frames.clear();  // so that the reported memory is that of the tracker
    const fs::path output = folder / "result";
    MemoryWatch memory;
    JobControl control;
    if (video.watch_memory)
      control.report = [&](const Progress& progress) { memory.look(progress); };
    TrialResult result = judged(track(scene, std::move(config), output, control), shot.truth,
                                height_of(video.walker), output);
    if (video.watch_memory) {
      result.what += fmt::format("; second half {:+.1f} MB", memory.growth());
      if (memory.growth() > kMostMemoryGrowth) result.end = TrialEnd::kFailed;
    }
    return result;
  } catch (const InputError& error) {
    return {.end = TrialEnd::kReported, .what = error.what()};
  } catch (const UsageError& error) {
    return {.end = TrialEnd::kReported, .what = error.what()};
  }
}

}  // namespace jobs
}  // namespace walktrack
