#include "jobs/track/track.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "core/errors.h"
#include "io/archive/files.h"
#include "io/archive/run_record.h"
#include "io/archive/sha256.h"
#include "io/video/scene_video.h"
#include "jobs/check/check.h"
#include "jobs/track/report/quality_words.h"
#include "jobs/track/report/report.h"
#include "jobs/track/report/track_quality.h"
#include "jobs/track/results/keypoint_results.h"
#include "jobs/track/results/named_track.h"
#include "jobs/track/results/overlay_video.h"
#include "jobs/track/results/planted_track.h"
#include "jobs/track/results/track_results.h"
#include "jobs/track/track_origin.h"
#include "jobs/track/track_run.h"

namespace walktrack {
inline namespace jobs {

namespace fs = std::filesystem;

namespace {

constexpr size_t kMaxSceneBytes = size_t{1} << 24;

struct Counts {
  int tracked = 0, first = -1, lost = 0, fallen = 0, diverged = 0;
};

Counts count(const TrackedFrames& frames) {
  Counts out;
  int frame = 0;
  for (const FrameRecord& record : frames.records) {
    out.fallen += record.fallen;
    out.diverged += record.diverged;
    if (record.tracked) {
      ++out.tracked;
      if (out.first < 0) out.first = frame;
    } else if (out.first >= 0) {
      ++out.lost;
    }
    ++frame;
  }
  return out;
}

std::vector<double> by_frame(const TrackedFrames& frames, double (*value)(const FrameRecord&)) {
  std::vector<double> out;
  for (const FrameRecord& record : frames.records)
    out.push_back(record.tracked ? value(record) : std::numeric_limits<double>::quiet_NaN());
  return out;
}

std::vector<std::string_view> term_names() {
  std::vector<std::string_view> names;
  Terms::each([&]<typename Term>() { names.push_back(Term::kName); });
  return names;
}

// "evidence.silhouettes.side": a list for every term and camera that says anything.
void add_evidence(const Scene& scene, const TrackedFrames& frames,
                  std::vector<std::pair<std::string, std::vector<double>>>& out) {
  constexpr double kSilent = std::numeric_limits<double>::quiet_NaN();
  const size_t lists = scene.cameras.size() * Terms::kCount;
  std::vector<std::vector<double>> values(lists);
  for (const FrameRecord& record : frames.records)
    for (size_t i = 0; i < lists; ++i)
      values[i].push_back(record.evidence.empty()
                              ? kSilent
                              : record.evidence[i / Terms::kCount][i % Terms::kCount]);
  const std::vector<std::string_view> names = term_names();
  for (size_t i = 0; i < lists; ++i) {
    const bool says = !std::all_of(values[i].begin(), values[i].end(),
                                   [](double value) { return std::isnan(value); });
    if (says)
      out.emplace_back(fmt::format("evidence.{}.{}", names[i % Terms::kCount],
                                   scene.cameras[i / Terms::kCount].name),
                       std::move(values[i]));
  }
}

std::string overlap_key(const SceneCamera& camera) { return "overlap_percent." + camera.name; }

// How well the figure lies on the person in that camera, by frame; NaN where nothing tells.
std::vector<double> overlap_percents(const TrackedFrames& frames, size_t camera) {
  std::vector<double> out;
  for (const FrameRecord& record : frames.records) {
    const std::vector<double>& all = record.fit.overlap;
    out.push_back(record.tracked && camera < all.size() ? 100 * all[camera]
                                                        : std::numeric_limits<double>::quiet_NaN());
  }
  return out;
}

// Of the reported pelvis over the ground, from the frame before to the one after, m/s; of an end of
// what was tracked, from or to the frame itself. NaN where there is no figure, or one alone.
std::vector<double> pelvis_speeds(const TrackedFrames& frames) {
  const Motion motion = motion_of(frames);
  const auto seen = [&](size_t i) { return known(motion.joints[i][Joint::kPelvis]); };
  std::vector<double> out;
  for (size_t i = 0; i < motion.time.size(); ++i) {
    const size_t from = i > 0 && seen(i - 1) ? i - 1 : i;
    const size_t to = i + 1 < motion.time.size() && seen(i + 1) ? i + 1 : i;
    const Eigen::Vector3d way =
        motion.joints[to][Joint::kPelvis] - motion.joints[from][Joint::kPelvis];
    out.push_back(way.head<2>().norm() / (motion.time[to] - motion.time[from]));
    if (!seen(i) || from == to) out.back() = std::numeric_limits<double>::quiet_NaN();
  }
  return out;
}

std::string pace_note(const BudgetConfig& budget) {
  return fmt::format(
      "not deterministic: {} to {} particles, as many as {:g} ms a frame allowed on this machine",
      budget.least_particles, budget.most_particles, budget.frame_ms);
}

std::string size_note(const Stature& stature) {
  return fmt::format(
      "the scene does not say how tall the subject is: {:.2f} m, give or take {:.2f}, from the "
      "images",
      stature.height, stature.sd);
}

RunRecord record_of(const TrackJob& job, const Origin& inputs, const TrackRun& run,
                    const TrackedFrames& frames, const TrackOutcome& outcome,
                    const Quality& quality, const WrittenTables& tables, const Elapsed& spent) {
  const Counts counts = count(frames);
  RunRecord out;
  out.command = "track";
  out.scene = job.scene.file.filename().string();
  out.scene_digest = sha256(read_text_file(job.scene.file, kMaxSceneBytes));
  out.inputs = inputs;
  out.config = job.config;
  out.status = status_word(outcome.status);
  if (!outcome.message.empty()) out.notes.push_back(outcome.message);
  out.notes.insert(out.notes.end(), outcome.checks.begin(), outcome.checks.end());
  const bool paced = job.config.values.budget.frame_ms > 0;
  if (paced) out.notes.push_back(pace_note(job.config.values.budget));
  if (run.stature()) out.notes.push_back(size_note(*run.stature()));
  for (const std::string& note : run.notes()) out.notes.push_back(note);
  out.numbers = {{"frames", double(frames.records.size())},
                 {"frame_rate", frames.frame_rate},
                 {"video_seconds", double(frames.records.size()) / frames.frame_rate},
                 {"tracked_frames", double(counts.tracked)},
                 {"first_tracked_frame", double(counts.first)},
                 {"lost_frames", double(counts.lost)},
                 {"losses", double(run.losses())},
                 {"foot_changes", double(foot_changes(frames))},
                 {"fallen_particles", double(counts.fallen)},
                 {"diverged_particles", double(counts.diverged)},
                 {"distance_m", tables.totals.distance},
                 {"positive_work_j", tables.totals.positive_work},
                 {"negative_work_j", tables.totals.negative_work},
                 {"cost_of_transport", tables.totals.cost_of_transport},
                 {"peak_foot_load_body_weights", tables.totals.peak_load}};
  if (run.stature()) {
    out.numbers.emplace_back("estimated_height_m", run.stature()->height);
    out.numbers.emplace_back("estimated_height_sd_m", run.stature()->sd);
  }
  if (outcome.lag) {
    out.numbers.emplace_back("lag_frames_" + job.scene.cameras[outcome.lag->camera].name,
                             outcome.lag->frames);
    out.numbers.emplace_back("lag_sd_frames", outcome.lag->sd_frames);
  }
  const std::vector<double> overlaps = mean_overlaps(frames);
  for (size_t c = 0; c < overlaps.size(); ++c)
    out.numbers.emplace_back(overlap_key(job.scene.cameras[c]), 100 * overlaps[c]);
  for (const auto& number : keypoint_numbers(run.keypoints())) out.numbers.push_back(number);
  out.quality = quality;
  out.by_frame = {
      {"ess", by_frame(frames, [](const FrameRecord& r) { return r.filter.ess; })},
      {"log_evidence",
       by_frame(frames, [](const FrameRecord& r) { return r.filter.log_evidence; })},
      {"layers", by_frame(frames, [](const FrameRecord& r) { return double(r.filter.layers); })},
      {"left_stance",
       by_frame(frames, [](const FrameRecord& r) { return r.estimate.left_stance; })},
      {"stride_phase", by_frame(frames, [](const FrameRecord& r) { return r.modes.phase; })},
      {"legs_exchanged",
       by_frame(frames, [](const FrameRecord& r) { return r.modes.p_legs_swapped; })},
      {"standing", by_frame(frames, [](const FrameRecord& r) { return r.modes.standing; })},
      {"speed", pelvis_speeds(frames)}};
  add_evidence(job.scene, frames, out.by_frame);
  for (size_t c = 0; c < job.scene.cameras.size(); ++c)
    out.by_frame.emplace_back(overlap_key(job.scene.cameras[c]), overlap_percents(frames, c));
  for (auto& list :
       keypoint_residuals(frames, with_stature(job.scene, run.stature()), job.config.values))
    out.by_frame.push_back(std::move(list));
  if (paced) out.by_frame.emplace_back("particles", run.particles_used());
  out.digest = tables.digest;
  out.command_line = job.command_line;
  out.threads = run.threads();
  out.resumed_at_frame = run.first_frame();
  out.stage_seconds = run.watch().stages();
  out.stage_cpu_seconds = run.watch().cpu_stages();
  out.seconds = spent.seconds;
  out.cpu_seconds = spent.cpu;
  out.frames_per_second = outcome.frames_per_second;
  out.stride_frames_per_second = outcome.stride_frames_per_second;
  return out;
}

TrackStatus judge(TrackRun& run, const Quality& quality, const SceneVideo& video, bool interrupted,
                  const JobControl& control, std::string& trouble) {
  if (interrupted) return TrackStatus::kInterrupted;
  trouble = video.trouble();
  if (!trouble.empty()) return TrackStatus::kCutShort;
  if (count(run.frames()).tracked == 0) {
    trouble = "nobody was found walking" + run.why_nobody(control);
    return TrackStatus::kNotFound;
  }
  trouble = first_failure(quality);
  return trouble.empty() ? TrackStatus::kTracked : TrackStatus::kQualityFailed;
}

// With every term off there would be nothing but the walker's own gait.
void require_a_term(const ObservationConfig& observation) {
  const std::vector<TermSwitch> switches = term_switches();
  std::vector<std::string_view> names;
  for (const TermSwitch& each : switches) {
    if (each.on(observation)) return;
    names.push_back(each.key);
  }
  throw UsageError(
      describe({"", 0, "observation"}, "no term that is enabled",
               fmt::format("one or more of {} with enabled: true", fmt::join(names, ", "))));
}

// Why a sound checkpoint is of no use for this job; "": it is.
std::string trouble_with(const Checkpoint& checkpoint, const TrackJob& job) {
  const fs::path file = job.output / kCheckpointFile;
  if (checkpoint.observers.size() != job.scene.cameras.size())
    return fmt::format("{}: the checkpoint is of another number of cameras", file.string());
  return frame_file_trouble(job.output / kFramesFile, checkpoint.records, checkpoint.record_bytes);
}

// Says what a complete result was made of otherwise, or refuses to make it again.
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
    control.say(fmt::format("{}: made again, for it was of other settings or inputs ({})",
                            job.output.string(), changed));
}

struct LookedAt {
  std::vector<std::string> notes;
  std::optional<FoundLag> lag;
};

// Says and hands back what the scene's checks found. InputError for the first failure, with its
// cure, unless failures are to be ignored.
LookedAt looked_at(const TrackJob& job, const JobControl& control) {
  const CheckReport report = look_at_scene(job.scene, control);
  LookedAt out{{}, report.lag};
  std::vector<std::string>& notes = out.notes;
  std::string failure;
  int more = -1;
  for (const Finding& finding : report.findings) {
    if (finding.failure && failure.empty()) failure = finding_line(finding);
    if (finding.failure) ++more;
    notes.push_back((finding.failure ? "a failed check was ignored: " : "") +
                    finding_line(finding));
  }
  if (!failure.empty() && !job.ignore_checks) {
    throw InputError(fmt::format(
        "{}: {}{} (--ignore-checks tracks it as it is)", job.scene.file.string(), failure,
        more > 0 ? fmt::format("; and {} more, see walktrack check", more) : std::string()));
  }
  for (const std::string& note : notes) control.say(note);
  return out;
}

// The checkpoint to go on from, if that is wanted and there is one that fits.
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

// Frame by frame to the video's end; whether it was told to stop before.
bool follow_video(TrackRun& run, const SceneVideo& video, const JobControl& control,
                  TrackOutcome& outcome) {
  const auto total = static_cast<size_t>(std::max(0, video.frame_count()));
  run.skip(control);
  bool stopped = false;
  while (!(stopped = control.stopping()) && run.step())
    control.progress("tracking", static_cast<size_t>(run.frames_read()), total);
  outcome.resumable = run.finish(stopped);
  outcome.frames = run.frames_read();
  outcome.stride_frames_per_second = run.stride_frames_per_second();
  return stopped;
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

TrackOutcome track_scene(const TrackJob& given, const JobControl& control) {
  const TimePoint start;
  TrackJob job = given;
  const std::string no_network = missing_network_note(job.scene, job.config.values);
  job.config.values.observation = decided_terms(job.scene, job.config.values);
  const TimePoint looking;
  require_a_term(job.config.values.observation);
  TrackOutcome outcome;
  LookedAt looked = looked_at(job, control);
  outcome.checks = std::move(looked.notes);
  if (!no_network.empty()) {
    control.say(no_network);
    outcome.checks.push_back(no_network);
  }
  outcome.lag = looked.lag;
  if (looked.lag) job.scene.cameras[looked.lag->camera].start_frame = looked.lag->frames;
  const Elapsed checking = elapsed_since(looking);
  SceneVideo video(job.scene);
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
  const bool interrupted = follow_video(run, video, control, outcome);
  const TimePoint writing;
  const SmoothingConfig& smoothing = job.config.values.smoothing;
  std::optional<TrackedFrames> sided, light, still;
  if (says_names(run.frames()))
    sided.emplace(named(run.frames(), run.body(), folder.file(std::string(kNamedFile))));
  const TrackedFrames& tracked = sided ? *sided : run.frames();
  if (smoothing.lag > 0)
    light.emplace(smoothed(tracked, smoothing, folder.file(std::string(kSmoothedFile))));
  const TrackedFrames& moving = light ? *light : tracked;
  if (smoothing.plant) still.emplace(planted(moving, folder.file(std::string(kPlantedFile))));
  const TrackedFrames& frames = still ? *still : moving;
  const Scene scene = with_stature(job.scene, run.stature());
  const AnalysedMotion analysed =
      analysed_motion(frames, scene, job.config.values.tracker.model_error);
  Quality quality = quality_of(frames, moving, job.config.values.quality,
                               leg_length(body_lengths(scene.subject)));
  if (const auto detected =
          quality_of_keypoints(total_use(run.keypoints()), job.config.values.quality))
    quality.push_back(*detected);
  quality.push_back(quality_measure("scale_sd_percent", 100 * analysed.figure_error.scale));
  outcome.status = judge(run, quality, video, interrupted, control, outcome.message);
  outcome.tracked = count(frames).tracked;
  if (run.stature()) control.say(size_note(*run.stature()));
  for (const std::string& note : run.notes()) control.say(note);
  const JointUncertainty uncertainty = uncertainty_of(frames);
  KineticsConfig forces = job.config.values.kinetics;
  forces.cutoff_hz = forces.tracked_cutoff_hz;
  const WrittenTables tables = write_tables(analysed, uncertainty, forces, folder);
  outcome.walk = tables.walk;
  if (outcome.status == TrackStatus::kQualityFailed) outcome.failed_checks = failures(quality);
  std::vector<ReportClip> clips;
  if (job.overlay && outcome.frames > 0)
    clips = write_overlays(job, frames, folder, run.threads(), control);
  run.watch().add("output", elapsed_since(writing));
  const Elapsed spent = elapsed_since(start);
  outcome.frames_per_second = (outcome.frames - run.first_frame()) / spent.seconds;
  const std::string record =
      run_json(record_of(job, inputs, run, frames, outcome, quality, tables, spent));
  outcome.open_first = write_report(
      folder, {job.scene.file, analysed, uncertainty, job.scene.cameras, record, clips});
  const bool partial =
      outcome.status == TrackStatus::kInterrupted || outcome.status == TrackStatus::kCutShort;
  if (!outcome.resumable) folder.remove(kFilesOfWork);
  partial ? folder.finish_partial(record) : folder.finish(record);
  return outcome;
}

}  // namespace jobs
}  // namespace walktrack
