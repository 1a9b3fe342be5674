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
#include "jobs/optimise/outliers.h"
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

// The motion at the times of frames, from `first` to its end. Files round their times, so that the
// last row may be a little too early for its frame.
Motion at_frames(const Motion& motion, double rate, double first) {
  const double period = 1 / rate, end = motion.time.back();
  std::vector<double> times;
  for (size_t i = 0; times.empty() || times.back() + 0.5 * period < end; ++i) {
    const double time = first + static_cast<double>(i) * period;
    times.push_back(time > end && time < end + 0.1 * period ? end : time);
  }
  return resampled(motion, times, kLongestGap);
}

// Hz; the mean over rows without a gap between them, because files round their times.
double rate_of(const Motion& motion) {
  const double period = sample_period(motion);
  double sum = 0;
  size_t count = 0;
  for (size_t i = 1; i < motion.time.size(); ++i) {
    const double step = motion.time[i] - motion.time[i - 1];
    if (step > 1.5 * period) continue;
    sum += step;
    ++count;
  }
  return static_cast<double>(count) / sum;
}

bool has_arms(const Motion& motion) {
  return std::ranges::any_of(motion.joints, [](const JointPositions& joints) {
    return known(joints[Joint::kLeftElbow]) && known(joints[Joint::kRightElbow]);
  });
}

Subject subject_of(const OptimiseJob& job, const Motion& motion) {
  Subject out = job.scene ? job.scene->subject : Subject{};
  if (job.height) {
    out.height = *job.height;
  } else if (!job.scene || !(job.scene->height_given || job.scene->height_sd)) {
    out.height = stature_of(motion);
  }
  if (job.mass) out.mass = *job.mass;
  return with_lengths_of(motion, out);
}

bool is_mass_stated(const OptimiseJob& job) {
  return job.mass || (job.scene && job.scene->mass_given);
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

Motion later(Motion motion, double by) {
  for (double& time : motion.time) time += by;
  return motion;
}

// Frames begin at 0, but a motion without a scene keeps its times. Given tracks have no transfers.
AnalysedMotion later(AnalysedMotion analysed, double by) {
  analysed.motion = later(std::move(analysed.motion), by);
  for (AngleRow& row : analysed.angles) row.time += by;
  analysed.members.member = [by, member = analysed.members.member](size_t index) {
    return later(member(index), by);
  };
  return analysed;
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
                    {"floor_height_mm", 1000 * outcome.floor_height},
                    {"replaced_joints", static_cast<double>(outcome.replaced)}};
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

// A motion at the times of the frames, and what became of it.
struct Given {
  const OptimiseJob& job;
  const TrackJob& track;
  const Motion& motion;
  const GivenTrack& frames;
};

OptimiseOutcome written_result(const Given& given, OptimiseOutcome outcome,
                               const ResultFolder& folder, const TimePoint& start,
                               const JobControl& control) {
  const auto& [job, track, motion, frames] = given;
  const BandScene bands = bands_of(job, track.scene);
  const ReportedTrack reported(frames.frames, frames.model, {true, true}, bands, folder);
  const AnalysedMotion analysed = later(
      analysed_motion(reported.frames(), track.scene, bands.model_error), motion.time.front());
  const Motion before = with_frames_of(motion, frames.frames);
  outcome.frames = frames.frames.records.size();
  outcome.used = static_cast<size_t>(frame_counts(frames.frames).tracked);
  outcome.changes = changes_of(before, analysed.motion, track.scene.subject, track.scene.gravity,
                               job.config.values.kinetics);
  outcome.moved = mean_displacement(before, analysed.motion);
  const JointUncertainty uncertainty = uncertainty_of(reported.frames());
  const WrittenTables tables = write_tables(analysed, uncertainty, forces_of(job), folder);
  folder.write(kSubjectFile, subject_text({.subject = track.scene.subject,
                                           .height_sd = std::nullopt,
                                           .height_stated = true,
                                           .mass_stated = is_mass_stated(job),
                                           .girth_stated = track.scene.girth_given,
                                           .file = {}}));
  const int threads = thread_count(job.config.values.threads);
  std::vector<ReportClip> clips;
  if (track.overlay) clips = write_overlays(track, reported.frames(), folder, threads, control);
  RunRecord record = record_of(job, track, analysed, outcome, tables.digest);
  record.threads = threads;
  record.seconds = elapsed_since(start).seconds;
  const std::string text = run_json(record);
  outcome.open_first =
      write_report(folder, {file_of(job), analysed, uncertainty, track.scene.cameras, text, clips});
  folder.remove(kFilesOfWork);
  folder.finish(text);
  return outcome;
}

}  // namespace

OptimiseOutcome optimise(const OptimiseJob& given_job, const JobControl& control) {
  const TimePoint start;
  OptimiseJob job = given_job;
  OptimiseOutcome outcome;
  const Motion motion = given_motion(job);
  job.config.values.body.arms = has_arms(motion);
  const Subject subject = subject_of(job, motion);
  TrackJob track = track_job(job, scene_of(job, subject));
  const Outputs outputs = outputs_of(job, track);
  refuse_what_is_not_ours(outputs);
  std::optional<SceneVideo> video;
  if (job.scene) {
    track = checked_job(track, control).job;
    video.emplace(track.scene);
  }
  const double rate = video ? video->frame_rate() : rate_of(motion);
  const Motion at_times = at_frames(motion, rate, video ? 0 : motion.time.front());
  Motion usable = at_times;
  outcome.replaced = replace_outliers(usable);
  outcome.floor_height = floor_height(usable, subject);
  usable = on_floor(std::move(usable), outcome.floor_height);
  const ResultFolder folder(outputs, job.overwrite);
  const GivenTrack frames =
      video ? given_track(usable, track, *video, job.joint_sd, folder, control)
            : given_track(usable, subject, rate, job.joint_sd, job.config.values, folder);
  if (control.stopping()) {
    folder.remove(kFilesOfWork);
    outcome.interrupted = true;
    return outcome;
  }
  require_frames(job, frames.frames, folder);
  return written_result({job, track, at_times, frames}, outcome, folder, start, control);
}

}  // namespace jobs
}  // namespace walktrack
