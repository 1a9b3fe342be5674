#include "jobs/optimise/optimise.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "core/errors.h"
#include "io/archive/files.h"
#include "io/archive/sha256.h"
#include "io/tables/motion_file.h"
#include "io/video/scene_video.h"
#include "jobs/optimise/given_track.h"
#include "jobs/track/checked_job.h"
#include "jobs/track/report/report.h"
#include "jobs/track/report/track_quality.h"
#include "jobs/track/report/track_record.h"
#include "jobs/track/results/overlay_video.h"
#include "jobs/track/results/reported_track.h"
#include "jobs/track/stopwatch.h"
#include "jobs/track/track_origin.h"
#include "jobs/track/track_run.h"
#include "metrics/joint_error.h"
#include "tracker/smooth/joint_fit.h"

namespace walktrack {
inline namespace jobs {

namespace {

namespace fs = std::filesystem;

constexpr size_t kMostBytes = size_t{1} << 30;  // of the motion
constexpr double kLongestGap = 0.25;  // s between rows of the motion that are interpolated

fs::path file_of(const OptimiseJob& job) {
  return fs::is_directory(job.motion) ? job.motion / "joints.csv" : job.motion;
}

Motion given_motion(const OptimiseJob& job) {
  const fs::path file = file_of(job);
  Motion motion = read_motion(file, job.scene ? job.scene->world : WorldFrame{});
  if (motion.time.size() < 2)
    throw InputError(describe({file.string(), 0, ""}, "fewer than two rows", "a motion"));
  return motion;
}

// The motion at the times of frames, from 0 to its end.
Motion at_frames(const Motion& motion, double rate) {
  std::vector<double> times;
  const auto last = static_cast<size_t>(std::max(0.0, std::floor(motion.time.back() * rate + 0.5)));
  for (size_t i = 0; i <= last; ++i) times.push_back(static_cast<double>(i) / rate);
  return resampled(motion, times, kLongestGap);
}

Subject subject_of(const OptimiseJob& job, const Motion& motion) {
  Subject out = job.scene ? job.scene->subject : Subject{};
  if (job.height) {
    out.height = *job.height;
  } else if (!job.scene || !job.scene->height_given) {
    out.height = stature_of(motion);
  }
  if (job.mass) out.mass = *job.mass;
  return with_lengths_of(motion, out);
}

// Other tools' floors are off by centimetres, so that the motion is lowered onto ours first.
Motion on_floor(Motion motion, double floor) {
  for (JointPositions& joints : motion.joints)
    for (Eigen::Vector3d& joint : joints.at) joint.z() -= floor;
  return motion;
}

Scene scene_of(const OptimiseJob& job, const Subject& subject) {
  Scene out = job.scene.value_or(Scene{});
  out.subject = subject;
  out.height_given = true;
  return out;
}

TrackJob track_job(const OptimiseJob& job, const Scene& scene) {
  TrackJob out;
  out.scene = scene;
  out.config = job.config;
  out.output = job.output;
  out.overwrite = job.overwrite;
  out.overlay = job.overlay && job.scene;
  out.ignore_checks = job.ignore_checks;
  out.command_line = job.command_line;
  return out;
}

Outputs outputs_of(const OptimiseJob& job, const TrackJob& track) {
  Outputs out = track_outputs(track);
  out.command = "optimise";
  out.inputs.push_back(file_of(job));
  return out;
}

Motion with_frames_of(const Motion& motion, const TrackedFrames& frames) {
  Motion out = motion;
  out.time.resize(std::min(out.time.size(), frames.records.size()));
  out.joints.resize(out.time.size());
  return out;
}

// Mean displacement of scored joints that are known in both motions.
double mean_displacement(const Motion& before, const Motion& after) {
  double sum = 0;
  size_t count = 0;
  for (size_t i = 0; i < std::min(before.time.size(), after.time.size()); ++i) {
    for (const Joint joint : kScoredJoints) {
      const Eigen::Vector3d moved = after.joints[i][joint] - before.joints[i][joint];
      if (!known(moved)) continue;
      sum += moved.norm();
      ++count;
    }
  }
  return count > 0 ? sum / static_cast<double>(count) : 0;
}

void require_frames(const OptimiseJob& job, const TrackedFrames& frames,
                    const ResultFolder& folder) {
  if (frame_counts(frames).tracked > 0) return;
  folder.remove(kFilesOfWork);
  throw InputError(describe(
      {file_of(job).string(), 0, ""}, "no frame with hips, knees and ankles",
      job.scene ? "such frames during the videos of the scene" : "one such frame at least"));
}

// Without cameras nothing is known about the model's error, so that bands only have the draws.
BandScene bands_of(const OptimiseJob& job, const Scene& scene) {
  BandScene out{{}, job.scene ? job.config.values.tracker.model_error : 0, job.config.values.seed};
  for (const SceneCamera& each : scene.cameras) out.cameras.push_back(each.camera);
  return out;
}

RunRecord record_of(const OptimiseJob& job, const TrackJob& track, const AnalysedMotion& analysed,
                    const OptimiseOutcome& outcome, const std::string& digest) {
  RunRecord record;
  record.command = "optimise";
  record.scene = file_of(job).filename().string();
  record.scene_digest = sha256(read_text_file(file_of(job), kMostBytes));
  if (job.scene)
    record.inputs = input_digests(track.scene, track.config.values.observation.keypoints);
  record.config = track.config;
  record.status = "optimised";
  record.numbers = {{"frames", static_cast<double>(outcome.frames)},
                    {"tracked_frames", static_cast<double>(outcome.used)},
                    {"height_m", analysed.subject.height},
                    {"mass_kg", analysed.subject.mass},
                    {"moved_mm", 1000 * outcome.moved},
                    {"floor_height_mm", 1000 * outcome.floor_height}};
  for (const Change& each : outcome.changes) {
    record.numbers.emplace_back(each.name + "_before", each.before);
    record.numbers.emplace_back(each.name + "_after", each.after);
  }
  record.quality =
      quality_of_motion(analysed.motion, analysed.rate, leg_length(body_lengths(analysed.subject)));
  record.digest = digest;
  record.command_line = job.command_line;
  return record;
}

KineticsConfig forces_of(const OptimiseJob& job) {
  KineticsConfig out = job.config.values.kinetics;
  out.cutoff_hz = out.tracked_cutoff_hz;
  return out;
}

// The rest, once the frames are there.
void write_result(const OptimiseJob& job, const TrackJob& track_of, const Motion& given,
                  const GivenTrack& track, const ResultFolder& folder, const TimePoint& start,
                  const JobControl& control, OptimiseOutcome& outcome) {
  const ReportedTrack reported(track.frames, track.model, {true, true},
                               bands_of(job, track_of.scene), folder);
  const AnalysedMotion analysed =
      analysed_motion(reported.frames(), track_of.scene, bands_of(job, track_of.scene).model_error);
  const Motion before = with_frames_of(given, track.frames);
  outcome.frames = track.frames.records.size();
  outcome.used = static_cast<size_t>(frame_counts(track.frames).tracked);
  outcome.changes = changes_of(before, analysed.motion, track_of.scene.subject,
                               track_of.scene.gravity, job.config.values.kinetics);
  outcome.moved = mean_displacement(before, analysed.motion);
  const JointUncertainty uncertainty = uncertainty_of(reported.frames());
  const WrittenTables tables = write_tables(analysed, uncertainty, forces_of(job), folder);
  std::vector<ReportClip> clips;
  if (track_of.overlay)
    clips = write_overlays(track_of, reported.frames(), folder,
                           thread_count(job.config.values.threads), control);
  RunRecord record = record_of(job, track_of, analysed, outcome, tables.digest);
  record.threads = thread_count(job.config.values.threads);
  record.seconds = elapsed_since(start).seconds;
  const std::string text = run_json(record);
  outcome.open_first = write_report(
      folder, {file_of(job), analysed, uncertainty, track_of.scene.cameras, text, clips});
  folder.remove(kFilesOfWork);
  folder.finish(text);
}

}  // namespace

OptimiseOutcome optimise(const OptimiseJob& job, const JobControl& control) {
  const TimePoint start;
  OptimiseOutcome outcome;
  const Motion motion = given_motion(job);
  const Subject subject = subject_of(job, motion);
  outcome.floor_height = floor_height(motion, subject);
  TrackJob track = track_job(job, scene_of(job, subject));
  const Outputs outputs = outputs_of(job, track);
  refuse_what_is_not_ours(outputs);
  if (!job.scene) {
    const double rate = 1 / sample_period(motion);
    const ResultFolder folder(outputs, job.overwrite);
    const GivenTrack given = given_track(on_floor(motion, outcome.floor_height), subject, rate,
                                         job.joint_sd, job.config.values, folder);
    require_frames(job, given.frames, folder);
    write_result(job, track, motion, given, folder, start, control, outcome);
    return outcome;
  }
  track = checked_job(track, control).job;
  SceneVideo video(track.scene);
  const Motion at_times = at_frames(motion, video.frame_rate());
  const ResultFolder folder(outputs, job.overwrite);
  const GivenTrack given = given_track(on_floor(at_times, outcome.floor_height), track, video,
                                       job.joint_sd, folder, control);
  if (control.stopping()) {
    folder.remove(kFilesOfWork);
    outcome.interrupted = true;
    return outcome;
  }
  require_frames(job, given.frames, folder);
  write_result(job, track, at_times, given, folder, start, control, outcome);
  return outcome;
}

}  // namespace jobs
}  // namespace walktrack
