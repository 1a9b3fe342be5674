#include "jobs/track.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <limits>

#include <fmt/format.h>
#include <opencv2/core.hpp>

#include "body/kinematics.h"
#include "core/parallel_for.h"
#include "io/files.h"
#include "io/run_record.h"
#include "io/scene_video.h"
#include "io/sha256.h"
#include "jobs/report.h"
#include "jobs/track_quality.h"
#include "jobs/track_results.h"
#include "jobs/track_setup.h"

namespace walktrack {

namespace {

constexpr size_t kMaxSceneBytes = size_t{1} << 24;

using Clock = std::chrono::steady_clock;

// Seconds by stage, in the order of first use.
class Stopwatch {
 public:
  void add(const std::string& stage, Clock::time_point since) {
    const double seconds = std::chrono::duration<double>(Clock::now() - since).count();
    for (auto& [name, sum] : stages_) {
      if (name != stage) continue;
      sum += seconds;
      return;
    }
    stages_.emplace_back(stage, seconds);
  }
  const std::vector<std::pair<std::string, double>>& stages() const { return stages_; }

 private:
  std::vector<std::pair<std::string, double>> stages_;
};

// Tracking one scene, frame by frame.
struct Run {
  const TrackJob& job;
  TrackSetup setup;
  GaitPrior prior = load_gait_prior();
  int threads;
  Tracker tracker;
  std::vector<Region> everywhere;
  SceneEvidence evidence;
  TrackedFrames frames;
  Stopwatch watch;
  double cpu_seconds = 0;  // of tracking

  Run(const TrackJob& the_job, TrackSetup the_setup, double frame_rate, int the_threads)
      : job(the_job),
        setup(std::move(the_setup)),
        threads(the_threads),
        tracker(setup.scene, prior, job.config.values.tracker, job.config.values.seed, threads),
        evidence(setup.observers.size()) {
    frames.frame_rate = frame_rate;
    for (const Camera& camera : setup.scene.cameras)
      everywhere.push_back(search_region(camera, job.scene.subject.height));
  }

  Region region(size_t camera) const {
    if (!tracker.tracking()) return everywhere[camera];
    constexpr double kReach = 0.5;  // m around the last pose: limbs, and the way of one frame
    const FrameEstimate& last = frames.records.back().estimate;
    return person_region(setup.scene.cameras[camera], last.pose.root.head<2>(),
                         job.scene.subject.height, kReach + last.speed * setup.scene.dt);
  }

  void observe(const SceneFrames& images) {
    const auto start = Clock::now();
    for (size_t c = 0; c < setup.observers.size(); ++c) {
      if (!images.fresh[c]) {
        evidence[c] = CameraEvidence{};  // a repeated frame says nothing new
        setup.observers[c].forget_previous_frame();
        continue;
      }
      setup.observers[c].observe(images.images[c], region(c), evidence[c]);
    }
    watch.add("evidence", start);
  }

  void follow() {
    const auto start = Clock::now();
    for (FrameRecord& record : tracker.push(evidence)) frames.records.push_back(std::move(record));
    watch.add("filter", start);
  }

  // Once tracked, every frame teaches what the walker looks like.
  void learn() {
    if (!tracker.tracking() || !job.config.values.observation.foreground.enabled) return;
    const auto start = Clock::now();
    const Body& body = setup.scene.model.body;
    const Pose& pose = frames.records.back().estimate.pose;
    const PosedParts parts = pose_parts(body, forward_kinematics(body, pose));
    for (size_t c = 0; c < setup.observers.size(); ++c)
      setup.observers[c].learn(evidence[c], project_parts(setup.scene.cameras[c], parts));
    watch.add("appearance", start);
  }
};

struct Counts {
  int tracked = 0, first = -1, lost = 0, fallen = 0, diverged = 0;
};

Counts count(const TrackedFrames& frames) {
  Counts out;
  for (size_t i = 0; i < frames.records.size(); ++i) {
    const FrameRecord& record = frames.records[i];
    out.fallen += record.fallen;
    out.diverged += record.diverged;
    if (record.tracked) {
      ++out.tracked;
      if (out.first < 0) out.first = static_cast<int>(i);
    } else if (out.first >= 0) {
      ++out.lost;
    }
  }
  return out;
}

std::vector<double> by_frame(const TrackedFrames& frames, double (*value)(const FrameRecord&)) {
  std::vector<double> out;
  for (const FrameRecord& record : frames.records)
    out.push_back(record.tracked ? value(record) : std::numeric_limits<double>::quiet_NaN());
  return out;
}

std::string_view status_word(TrackStatus status) {
  switch (status) {
    case TrackStatus::kTracked:
      return "tracked";
    case TrackStatus::kNotFound:
      return "not found";
    case TrackStatus::kBelowGates:
      return "below gates";
    case TrackStatus::kInterrupted:
      return "interrupted";
    case TrackStatus::kCutShort:
      return "cut short";
  }
  return "";
}

RunRecord record_of(const Run& run, const TrackOutcome& outcome, const Quality& quality,
                    const WrittenTables& tables, double seconds) {
  const TrackedFrames& frames = run.frames;
  const Counts counts = count(frames);
  RunRecord out;
  out.command = "track";
  out.scene = run.job.scene.file.filename().string();
  out.scene_digest = sha256(read_text_file(run.job.scene.file, kMaxSceneBytes));
  out.config = run.job.config;
  out.status = status_word(outcome.status);
  if (!outcome.trouble.empty()) out.notes.push_back(outcome.trouble);
  out.numbers = {{"frames", double(frames.records.size())},
                 {"tracked_frames", double(counts.tracked)},
                 {"first_tracked_frame", double(counts.first)},
                 {"lost_frames", double(counts.lost)},
                 {"losses", double(run.tracker.losses())},
                 {"foot_changes", double(foot_changes(frames))},
                 {"fallen_particles", double(counts.fallen)},
                 {"diverged_particles", double(counts.diverged)},
                 {"distance_m", tables.totals.distance},
                 {"positive_work_j", tables.totals.positive_work},
                 {"negative_work_j", tables.totals.negative_work},
                 {"cost_of_transport", tables.totals.cost_of_transport},
                 {"peak_foot_load_body_weights", tables.totals.peak_load}};
  out.quality = quality;
  out.by_frame = {
      {"ess", by_frame(frames, [](const FrameRecord& r) { return r.filter.ess; })},
      {"log_evidence",
       by_frame(frames, [](const FrameRecord& r) { return r.filter.log_evidence; })},
      {"layers", by_frame(frames, [](const FrameRecord& r) { return double(r.filter.layers); })},
      {"left_stance",
       by_frame(frames, [](const FrameRecord& r) { return r.estimate.left_stance; })},
      {"speed", by_frame(frames, [](const FrameRecord& r) { return r.estimate.speed; })}};
  out.digest = tables.digest;
  out.command_line = run.job.command_line;
  out.threads = run.threads;
  out.stage_seconds = run.watch.stages();
  out.tracking_cpu_seconds = run.cpu_seconds;
  out.seconds = seconds;
  return out;
}

TrackStatus judge(const Run& run, const Quality& quality, const SceneVideo& video,
                  const JobControl& control, std::string& trouble) {
  if (control.stopping()) return TrackStatus::kInterrupted;
  trouble = video.trouble();
  if (!trouble.empty()) return TrackStatus::kCutShort;
  if (count(run.frames).tracked == 0) {
    trouble = "nobody was found walking";
    return TrackStatus::kNotFound;
  }
  trouble = first_failure(quality);
  return trouble.empty() ? TrackStatus::kTracked : TrackStatus::kBelowGates;
}

}  // namespace

TrackOutcome track_scene(const TrackJob& job, const JobControl& control) {
  const auto start = Clock::now();
  SceneVideo video(job.scene);
  const ResultFolder folder(job.output, job.overwrite);
  const int wanted = job.config.values.threads;
  const int threads = wanted > 0 ? wanted : hardware_threads();
  cv::setNumThreads(threads);
  Run run(job, set_up(job.scene, job.config.values, video.frame_rate(), control),
          video.frame_rate(), threads);
  run.watch.add("background", start);
  const auto tracking = Clock::now();
  const std::clock_t cpu = std::clock();
  SceneFrames images;
  const auto total = static_cast<size_t>(std::max(0, video.frame_count()));
  TrackOutcome outcome;
  while (!control.stopping()) {
    const auto decode = Clock::now();
    if (!video.read(images)) break;
    run.watch.add("decode", decode);
    run.observe(images);
    run.follow();
    run.learn();
    control.progress("tracking", static_cast<size_t>(++outcome.frames), total);
  }
  for (FrameRecord& record : run.tracker.finish()) run.frames.records.push_back(std::move(record));
  run.cpu_seconds = double(std::clock() - cpu) / CLOCKS_PER_SEC;
  outcome.frames_per_second =
      outcome.frames / std::chrono::duration<double>(Clock::now() - tracking).count();
  const Quality quality = quality_of(run.frames, job.config.values.gates);
  outcome.status = judge(run, quality, video, control, outcome.trouble);
  outcome.tracked = count(run.frames).tracked;
  const auto writing = Clock::now();
  const AnalysedMotion analysed = analysed_motion(run.frames, job.scene);
  const JointUncertainty uncertainty = uncertainty_of(run.frames);
  KineticsConfig forces = job.config.values.kinetics;
  forces.cutoff_hz = forces.tracked_cutoff_hz;
  const WrittenTables tables = write_tables(analysed, uncertainty, forces, folder);
  std::vector<ReportClip> clips;
  if (job.overlay && outcome.frames > 0) clips = write_overlays(job, run.frames, folder, control);
  run.watch.add("output", writing);
  const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
  const std::string record = run_json(record_of(run, outcome, quality, tables, seconds));
  outcome.look_at = write_report(
      folder, {job.scene.file, analysed, uncertainty, job.scene.cameras, record, clips});
  const bool partial =
      outcome.status == TrackStatus::kInterrupted || outcome.status == TrackStatus::kCutShort;
  partial ? folder.finish_partial(record) : folder.finish(record);
  return outcome;
}

}  // namespace walktrack
