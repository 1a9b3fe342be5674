#include "jobs/selftest/selftest_trials.h"

// The table of trials.
#include <sys/resource.h>

#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "core/conventions.h"
#include "core/errors.h"
#include "core/rng.h"
#include "filter/particle_filter.h"
#include "io/drawing/picture.h"
#include "jobs/selftest/selftest_video.h"
#include "observation/image.h"

namespace walktrack {
inline namespace jobs {

namespace fs = std::filesystem;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Trial {
  const char* name;
  bool stress;  // a trial that takes minutes
  TrialResult (*run)(const fs::path& folder);
};

TrialResult try_walk(double speed, const fs::path& folder) {
  return try_video(video_of_walk(speed), folder);
}

TrialResult try_settings(const std::vector<std::string>& settings, const fs::path& folder) {
  TestVideo video = video_of_walk();
  video.settings = settings;
  return try_video(video, folder);
}

TrialResult try_scene(const std::string& lines, const fs::path& folder) {
  TestVideo video = video_of_walk();
  video.scene_lines = lines;
  return try_video(video, folder);
}

TrialResult try_degraded(void (*degrade)(Frames&), const fs::path& folder) {
  TestVideo video = video_of_walk();
  video.degrade = degrade;
  return try_video(video, folder);
}

TrialResult try_slope(double slope_deg, const fs::path& folder) {
  TestVideo video = video_of_walk();
  const double slope = rad_from_deg(slope_deg);
  video.scene_lines =
      fmt::format("gravity: [{:.4f}, 0, {:.4f}]\n", kStandardGravity * std::sin(slope),
                  -kStandardGravity * std::cos(slope));
  return try_video(video, folder);
}

// Cuts the video to fewer seconds, in which the walker need not make a step.
void cut(TestVideo& video, double seconds) {
  video.options.duration = seconds;
  video.settings.emplace_back("quality.least_steps=0");
}

// What differs from the camera of the other videos.
struct CameraSetup {
  int width_px = 160, height_px = 120;
  std::optional<double> focal_px{};
  std::optional<Eigen::Vector3d> position{}, look_at{};
  int enlarge = 1;
};

TrialResult try_camera(const CameraSetup& setup, const fs::path& folder) {
  TestVideo video = video_of_walk();
  RenderCamera& camera = video.options.cameras[0];
  camera.width_px = setup.width_px;
  camera.height_px = setup.height_px;
  camera.focal_px = setup.focal_px;
  camera.position = setup.position;
  camera.look_at = setup.look_at;
  video.enlarge = setup.enlarge;
  if (video.enlarge > 1) cut(video, 0.2);  // the frames take hundreds of megabytes
  return try_video(video, folder);
}

TrialResult try_rate(double rate, const fs::path& folder) {
  TestVideo video = video_of_walk();
  video.options.frame_rate = rate;
  if (rate > 60) video.options.duration = 0.8;
  return try_video(video, folder);
}

// Three frames: a start and two steps.
TrialResult try_many_particles(const char* count, const fs::path& folder) {
  TestVideo video = video_of_walk();
  // Start hypotheses have small filters of their own; here the large filter starts in the first
  // frame.
  video.settings = {fmt::format("filter.particles={}", count), "filter.max_layers=2",
                    "start.seconds=0"};
  cut(video, 0.07);
  return try_video(video, folder);
}

// The same walk is repeated for as many frames as wanted: memory must not grow with them.
TrialResult try_long(size_t frames, const fs::path& folder) {
  TestVideo video = video_of_walk();
  video.watch_memory = true;
  video.settings = {"filter.particles=30", "start.particles=10"};
  video.degrade = [frames](Frames& shot) {
    const size_t once = shot.size();
    for (size_t i = once; i < frames; ++i) shot.push_back(shot[i % once]);
  };
  return try_video(video, folder);
}

// A filter in one dimension with likelihoods that no float can represent.
TrialResult try_filter(double (*log_likelihood)(double x), bool may_die) {
  ParticleFilter<double> filter({.particles = 1000}, 1, 1);
  filter.start(std::vector<double>(1000, 0.0));
  int died = 0;
  double evidence = 0;
  for (uint32_t frame = 0; frame < 20; ++frame) {
    const FilterReport report = filter.step(
        frame,
        [frame](double& x, uint32_t i) {
          Rng rng(1, Purpose::kTest, frame, i);
          x += rng.normal();
          return true;
        },
        [&](double x) { return log_likelihood(x); },
        [](double& x, double scale, Rng& rng) { x += scale * rng.normal(); });
    evidence = report.log_evidence;
    if (std::isnan(evidence) || std::isnan(report.ess)) return {.what = "a figure is no number"};
    if (!report.all_dead) continue;
    ++died;
    filter.start(std::vector<double>(1000, 0.0));
  }
  if (died == 0) {
    return {.end = TrialEnd::kTracked, .what = fmt::format("log-evidence {:.4g}", evidence)};
  }
  return {.end = may_die ? TrialEnd::kReported : TrialEnd::kFailed,
          .what = fmt::format("all particles dead in {} of 20 frames, as the filter says", died)};
}

void keep_every(Frames& frames, size_t nth) {
  Frames kept;
  for (size_t i = 0; i < frames.size(); i += nth) kept.push_back(frames[i]);
  frames = kept;
}

constexpr std::array kTrials{
    // The only trial that has to pass the quality checks, and which therefore has half of the
    // default particles.
    Trial{"ordinary walk", false,
          [](const fs::path& f) { return try_settings({"start.particles=80"}, f); }},
    Trial{"ordinary walk, start not told", false,
          [](const fs::path& f) {
            TestVideo video = video_of_walk();
            video.state_initial = false;
            return try_video(video, f);
          }},
    Trial{"walk of 0.3 m/s", false, [](const fs::path& f) { return try_walk(0.3, f); }},
    Trial{"walk of 2.2 m/s", false, [](const fs::path& f) { return try_walk(2.2, f); }},
    Trial{"standing still, feet together", false,
          [](const fs::path& f) { return try_video(video_of_standing(0, 0), f); }},
    Trial{"turning on the spot, 90 deg/s", false,
          [](const fs::path& f) { return try_video(video_of_standing(0, 0.5 * kPi), f); }},
    Trial{"knees straight throughout", false,
          [](const fs::path& f) { return try_video(video_of_standing(1, 0), f); }},
    Trial{"1 particle", false,
          [](const fs::path& f) {
            return try_settings({"filter.particles=1", "start.particles=1"}, f);
          }},
    Trial{"10,000 particles", false,
          [](const fs::path& f) { return try_many_particles("10000", f); }},
    Trial{"1,000,000 particles", true,
          [](const fs::path& f) { return try_many_particles("1000000", f); }},
    Trial{"no noise at all", false,
          [](const fs::path& f) {
            return try_settings(
                {"motion.torque_noise_scale=0", "motion.phase_noise=0", "motion.yaw_rate_sd=0",
                 "motion.residual_scale=0", "motion.ball_drift=0", "motion.ball_slip=0",
                 "motion.footfall_sd=0", "motion.start_position_sd=0", "motion.control_noise=0",
                 "motion.aim_drift=0", "motion.phase_jump_rate=0"},
                f);
          }},
    Trial{"noise a thousand times", false,
          [](const fs::path& f) {
            TestVideo video = video_of_walk();
            video.options.duration = 0.5;  // short, because debris takes long to search
            video.settings = {"motion.torque_noise_scale=1000",
                              "motion.phase_noise=1",
                              "motion.yaw_rate_sd=80",
                              "motion.residual_scale=10",
                              "motion.ball_drift=1",
                              "motion.ball_slip=1",
                              "motion.footfall_sd=1",
                              "motion.start_position_sd=10",
                              "motion.control_noise=1",
                              "motion.aim_drift=1",
                              "motion.phase_jump_rate=100"};
            return try_video(video, f);
          }},
    Trial{"all log-weights -infinity", false,
          [](const fs::path&) { return try_filter([](double) { return -kInfinity; }, true); }},
    Trial{"log-likelihoods 1e6 nats apart", false,
          [](const fs::path&) { return try_filter([](double x) { return -1e6 * x * x; }, false); }},
    Trial{"log-likelihoods of -1e300 nats", false,
          [](const fs::path&) { return try_filter([](double x) { return -1e300 * x; }, false); }},
    Trial{"person 1 px high", false,
          [](const fs::path& f) {
            return try_camera({.focal_px = 9, .position = {{0, -16, 1.2}}}, f);
          }},
    Trial{"image of 1 px", false,
          [](const fs::path& f) { return try_camera({.width_px = 1, .height_px = 1}, f); }},
    Trial{"image of 2 x 500 px", false,
          [](const fs::path& f) { return try_camera({.width_px = 2, .height_px = 500}, f); }},
    Trial{"8K images, person 4,000 px high", true,
          [](const fs::path& f) {
            return try_camera(
                {.height_px = 90, .focal_px = 144, .position = {{0.2, -3, 0.9}}, .enlarge = 48}, f);
          }},
    Trial{"4K images", false, [](const fs::path& f) { return try_camera({.enlarge = 24}, f); }},
    Trial{"5 frames/s", false, [](const fs::path& f) { return try_rate(5, f); }},
    Trial{"240 frames/s", false, [](const fs::path& f) { return try_rate(240, f); }},
    Trial{"every frame twice", false,
          [](const fs::path& f) {
            return try_degraded(
                [](Frames& frames) {
                  for (size_t i = 1; i < frames.size(); i += 2) frames[i] = frames[i - 1];
                },
                f);
          }},
    Trial{"every other frame missing", false,
          [](const fs::path& f) {
            return try_degraded([](Frames& frames) { keep_every(frames, 2); }, f);
          }},
    Trial{"black frames now and then", false,
          [](const fs::path& f) {
            return try_degraded(
                [](Frames& frames) {
                  for (size_t i = 4; i < frames.size(); i += 7) fill(frames[i], 0);
                },
                f);
          }},
    Trial{"one colour throughout", false,
          [](const fs::path& f) {
            return try_degraded(
                [](Frames& frames) {
                  for (Image& frame : frames) fill(frame, 90);
                },
                f);
          }},
    Trial{"a single frame", false,
          [](const fs::path& f) {
            return try_degraded([](Frames& frames) { frames.resize(1); }, f);
          }},
    Trial{"frames that change their size", false,
          [](const fs::path& f) {
            return try_degraded([](Frames& frames) { frames[9] = frames[9].rowRange(0, 50); }, f);
          }},
    Trial{"camera looking away", false,
          [](const fs::path& f) {
            return try_camera({.position = {{0, -5, 1.2}}, .look_at = {{0, -9, 1.2}}}, f);
          }},
    Trial{"camera inside the body", false,
          [](const fs::path& f) {
            return try_camera({.position = {{1.2, 0, 1}}, .look_at = {{5, 0, 1}}}, f);
          }},
    Trial{"body of 0.3 m", false,
          [](const fs::path& f) { return try_video(video_of_body(0.3), f); }},
    Trial{"body of 3 m", false, [](const fs::path& f) { return try_video(video_of_body(3), f); }},
    Trial{"45 deg downhill", false, [](const fs::path& f) { return try_slope(45, f); }},
    Trial{"45 deg uphill", false, [](const fs::path& f) { return try_slope(-45, f); }},
    Trial{"gravity of the moon", false,
          [](const fs::path& f) { return try_scene("gravity: [0, 0, -1.62]\n", f); }},
    Trial{"gravity of a giant", false,
          [](const fs::path& f) { return try_scene("gravity: [0, 0, -99]\n", f); }},
    Trial{"gravity upwards", false,
          [](const fs::path& f) { return try_scene("gravity: [0, 0, 9.81]\n", f); }},
    Trial{"300 frames", false, [](const fs::path& f) { return try_long(300, f); }},
    Trial{"10,000 frames", true, [](const fs::path& f) { return try_long(10'000, f); }},
};

}  // namespace

std::vector<std::string> trial_names(bool stress) {
  std::vector<std::string> names;
  for (const Trial& trial : kTrials) {
    if (stress || !trial.stress) names.emplace_back(trial.name);
  }
  return names;
}

TrialResult run_trial(const std::string& name, const fs::path& folder) {
  if (fs::exists(folder) && !fs::is_empty(folder))
    throw UsageError(describe({folder.string(), 0, ""}, "files", "a new or empty folder"));
  for (const Trial& trial : kTrials) {
    if (name != trial.name) continue;
    TrialResult result = trial.run(folder);
    result.name = name;
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    result.peak_memory = static_cast<double>(usage.ru_maxrss) / 1024;  // from kB
    return result;
  }
  throw UsageError(fmt::format("no trial is called '{}', did you mean '{}'?", name,
                               nearest_word(name, trial_names(true))));
}

}  // namespace jobs
}  // namespace walktrack
