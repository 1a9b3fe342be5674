#include "jobs/track/track.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "core/errors.h"
#include "core/parallel_for.h"
#include "io/archive/files.h"
#include "io/video/scene_video.h"
#include "jobs/track/checked_job.h"
#include "jobs/track/report/quality_words.h"
#include "jobs/track/report/report.h"
#include "jobs/track/report/track_quality.h"
#include "jobs/track/report/track_record.h"
#include "jobs/track/results/keypoint_results.h"
#include "jobs/track/results/overlay_video.h"
#include "jobs/track/results/reported_track.h"
#include "jobs/track/results/track_results.h"
#include "jobs/track/track_origin.h"
#include "jobs/track/track_run.h"

namespace walktrack {
inline namespace jobs {

namespace fs = std::filesystem;

namespace {

TrackStatus judge(TrackRun& run, const Quality& quality, const SceneVideo& video, bool interrupted,
                  const JobControl& control, std::string& trouble) {
  if (interrupted) return TrackStatus::kInterrupted;
  trouble = video.trouble();
  if (!trouble.empty()) return TrackStatus::kCutShort;
  if (frame_counts(run.frames()).tracked == 0) {
    trouble = "nobody was found walking" + run.why_nobody(control);
    return TrackStatus::kNotFound;
  }
  trouble = first_failure(quality);
  return trouble.empty() ? TrackStatus::kTracked : TrackStatus::kQualityFailed;
}

// The reason why a valid checkpoint cannot be used for this job; "" if it can.
std::string trouble_with(const Checkpoint& checkpoint, const TrackJob& job) {
  const fs::path file = job.output / kCheckpointFile;
  if (checkpoint.observers.size() != job.scene.cameras.size())
    return fmt::format("{}: the checkpoint has another number of cameras", file.string());
  return frame_file_trouble(job.output / kFramesFile, checkpoint.records, checkpoint.record_bytes);
}

// Explains what differs from an earlier complete result, or refuses to compute it again.
void see_to_earlier_result(const TrackJob& job, const Origin& origin, const JobControl& control) {
  if (!is_complete_result(job.output)) return;
  const std::string changed = changes_since(job.output, origin);
  if (!job.overwrite) {
    throw UsageError(fmt::format("{} holds a complete result of {}; -y makes it again",
                                 job.output.string(),
                                 changed.empty() ? "these very settings and inputs"
                                                 : "other settings or inputs (" + changed + ")"));
  }
  if (!changed.empty())
    control.say(
        fmt::format("{}: made again, because it was made with other settings or inputs ({})",
                    job.output.string(), changed));
}

// The checkpoint to resume from, if that is wanted and there is a valid one.
std::optional<Checkpoint> checkpoint_for(const TrackJob& job, const Origin& origin,
                                         const JobControl& control) {
  if (!job.resume) {
    if (!job.overwrite && fs::exists(job.output / kCheckpointFile)) {
      throw UsageError(fmt::format(
          "{} holds the checkpoint of a run that was stopped; --resume goes on from it, -y starts "
          "anew",
          job.output.string()));
    }
    return std::nullopt;
  }
  FoundCheckpoint found = read_checkpoint(job.output / kCheckpointFile, origin);
  if (found.checkpoint) {
    const std::string trouble = trouble_with(*found.checkpoint, job);
    if (!trouble.empty()) found = {{}, trouble};
  }
  if (!found.unfit.empty()) {
    if (!job.overwrite) throw UsageError(found.unfit + "; -y starts anew");
    control.say(found.unfit + ": starting anew");
  }
  return std::move(found.checkpoint);
}

// Tracks frame by frame to the end of the video. Returns whether it was interrupted.
bool follow_video(TrackRun& run, const SceneVideo& video, const JobControl& control,
                  TrackOutcome& outcome) {
  const auto total = static_cast<size_t>(std::max(0, video.frame_count()));
  run.skip(control);
  bool stopped = false;
  while (!(stopped = control.stopping() && run.may_stop()) && run.step())
    control.progress("tracking", static_cast<size_t>(run.frames_read()), total);
  outcome.resumable = run.finish(stopped);
  outcome.frames = run.frames_read();
  outcome.stride_frames_per_second = run.stride_frames_per_second();
  return stopped;
}

Quality measured_quality(const TrackJob& job, const Scene& scene, const TrackRun& run,
                         const ReportedTrack& track, const AnalysedMotion& analysed) {
  const QualityConfig& limits = job.config.values.quality;
  Quality quality =
      quality_of(track.frames(), track.moving(), limits, leg_length(body_lengths(scene.subject)));
  if (const auto detected = quality_of_keypoints(total_use(run.keypoints()), limits))
    quality.push_back(*detected);
  quality.push_back(quality_measure("scale_sd_percent", 100 * analysed.figure_error.scale));
  return quality;
}

BandScene band_scene(const TrackJob& job) {
  BandScene out{{}, job.config.values.tracker.model_error, job.config.values.seed};
  for (const SceneCamera& each : job.scene.cameras) out.cameras.push_back(each.camera);
  return out;
}

KineticsConfig forces_of_track(const TrackJob& job) {
  KineticsConfig forces = job.config.values.kinetics;
  forces.cutoff_hz = forces.tracked_cutoff_hz;
  return forces;
}

void finish(const ResultFolder& folder, const TrackOutcome& outcome, const std::string& record) {
  const bool partial =
      outcome.status == TrackStatus::kInterrupted || outcome.status == TrackStatus::kCutShort;
  if (!outcome.resumable) folder.remove(kFilesOfWork);
  partial ? folder.finish_partial(record) : folder.finish(record);
}

// Of what was estimated of the subject, for other videos of the same person.
void write_subject(const TrackJob& job, const TrackRun& run, const ResultFolder& folder) {
  if (!run.estimates().any()) return;
  folder.write(kSubjectFile, subject_text(known_subject(job.scene, run.estimates())));
}

// Frames of the filter are reported as they are.
SmoothingConfig smoothing_of(const Config& config) {
  SmoothingConfig out = config.smoothing;
  out.enabled = out.enabled && config.tracker.estimate == EstimateKind::kMap;
  return out;
}

}  // namespace

std::string_view status_word(TrackStatus status) {
  switch (status) {
    case TrackStatus::kTracked:
      return "tracked";
    case TrackStatus::kNotFound:
      return "not found";
    case TrackStatus::kQualityFailed:
      return "below gates";
    case TrackStatus::kInterrupted:
      return "interrupted";
    case TrackStatus::kCutShort:
      return "cut short";
  }
  return "";
}

// What is missing if left and right rest on outlines alone; said before the video is tracked.
void report_missing_network(const TrackJob& given, const JobControl& control,
                            TrackOutcome& outcome) {
  const std::string note = missing_network_note(given.scene, given.config.values);
  if (note.empty()) return;
  control.say(note);
  outcome.checks.push_back(note);
}

TrackOutcome track_scene(const TrackJob& given, const JobControl& control) {
  const TimePoint start;
  TrackOutcome outcome;
  const CheckedJob checked = checked_job(given, control);
  const TrackJob& job = checked.job;
  outcome.checks = checked.findings;
  outcome.lag = checked.lag;
  const Elapsed checking = elapsed_since(start);
  SceneVideo video(job.scene);
  require_speeds_in_order(job.config.values.tracker.detector);
  require_room_for_search(job.scene, job.config.values, video.frame_rate());
  const Outputs outputs = track_outputs(job);
  refuse_what_is_not_ours(outputs);
  const Origin inputs = input_digests(job.scene, job.config.values.observation.keypoints);
  const Origin origin = origin_of(job.config, inputs);
  see_to_earlier_result(job, origin, control);
  std::optional<Checkpoint> checkpoint = checkpoint_for(job, origin, control);
  const ResultFolder folder(outputs, job.overwrite,
                            checkpoint ? kFilesOfWork : std::span<const std::string_view>{});
  TrackRun run(job, video, folder, origin, std::move(checkpoint), control);
  run.watch().add("checks", checking);
  report_missing_network(given, control, outcome);
  const bool interrupted = follow_video(run, video, control, outcome);
  const TimePoint writing;
  const ReportedTrack track(run.frames(), run.model(), smoothing_of(job.config.values),
                            band_scene(job), folder);
  const Scene scene = with_estimates(job.scene, run.estimates());
  const AnalysedMotion analysed =
      analysed_motion(track.frames(), scene, job.config.values.tracker.model_error);
  const Quality quality = measured_quality(job, scene, run, track, analysed);
  outcome.status = judge(run, quality, video, interrupted, control, outcome.message);
  if (outcome.status == TrackStatus::kQualityFailed) outcome.failed_checks = failures(quality);
  outcome.tracked = frame_counts(track.frames()).tracked;
  for (const std::string& note : subject_notes(job.scene, run)) control.say(note);
  for (const std::string& note : run.notes()) control.say(note);
  const JointUncertainty uncertainty = uncertainty_of(track.frames());
  WrittenTables tables;
  std::vector<ReportClip> clips;
  run_beside(
      run.threads(),
      [&] {
        if (job.overlay && outcome.frames > 0)
          clips = write_overlays(job, track.frames(), folder, run.threads(), control);
      },
      [&] { tables = write_tables(analysed, uncertainty, forces_of_track(job), folder); });
  outcome.walk = tables.walk;
  write_subject(job, run, folder);
  run.watch().add("output", elapsed_since(writing));
  const Elapsed spent = elapsed_since(start);
  outcome.frames_per_second = (outcome.frames - run.first_frame()) / spent.seconds;
  const std::string record =
      run_json(record_of(job, inputs, run, track.frames(), outcome, quality, tables, spent));
  outcome.open_first = write_report(
      folder, {job.scene.file, analysed, uncertainty, job.scene.cameras, record, clips});
  finish(folder, outcome, record);
  return outcome;
}

}  // namespace jobs
}  // namespace walktrack
