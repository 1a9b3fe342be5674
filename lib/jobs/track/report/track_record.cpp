#include "jobs/track/report/track_record.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "body/subject.h"
#include "io/archive/files.h"
#include "io/archive/sha256.h"
#include "jobs/track/report/recording_constants.h"
#include "jobs/track/report/track_quality.h"
#include "jobs/track/results/keypoint_results.h"
#include "tracker/figure/girth.h"
#include "tracker/figure/trunk_length.h"
#include "tracker/overlaps.h"

namespace walktrack {
inline namespace jobs {

namespace {

constexpr size_t kMaxSceneBytes = size_t{1} << 24;

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

// "evidence.silhouettes.side": a list for every term and camera with evidence.
void add_evidence(const Scene& scene, const TrackedFrames& frames, RunSeries& out) {
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

// Overlap of the figure with the subject in that camera, by frame; NaN if there is no evidence.
std::vector<double> overlap_percents(const TrackedFrames& frames, size_t camera) {
  std::vector<double> out;
  for (const FrameRecord& record : frames.records) {
    const std::vector<double>& all = record.fit.overlap;
    out.push_back(record.tracked && camera < all.size() ? 100 * all[camera]
                                                        : std::numeric_limits<double>::quiet_NaN());
  }
  return out;
}

// Speed of the reported pelvis over the ground by central differences, m/s; one-sided at the ends
// of a tracked interval, and NaN if it has only one frame.
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

// Of the tracked history, the share that is the walker's own motion; NaN if nobody was tracked.
double simulated_percent(const TrackedFrames& frames) {
  double sum = 0, count = 0;
  for (const FrameRecord& record : frames.records) {
    if (!record.tracked) continue;
    sum += 1 - record.history.jumped - record.history.caught;
    ++count;
  }
  return 100 * sum / count;
}

bool is_paced(const TrackJob& job) { return job.config.values.budget.frame_ms > 0; }

std::string size_note(const Scene& scene, const Stature& stature) {
  const std::string stated =
      scene.height_sd
          ? fmt::format("the scene says that the subject is {:.2f} m tall, give or take {:.2f}",
                        scene.subject.height, *scene.height_sd)
          : "the scene does not say how tall the subject is";
  return fmt::format(
      "{}: {:.2f} m, give or take {:.2f}, {} the images; subject.yaml has it for other "
      "videos of the same person",
      stated, stature.height, stature.sd, scene.height_sd ? "with" : "from");
}

std::string trunk_note(const Scene& scene, double trunk) {
  constexpr double kCmPerM = 100;
  const double longer = trunk - body_lengths(scene.subject).trunk;
  return fmt::format(
      "the outlines show that the subject's shoulders and head are {:.0f} cm {} above the hips "
      "than usual, give or take {:.0f}: they stoop, or have another trunk; subject.yaml has it for "
      "other videos of the same person",
      kCmPerM * std::abs(longer), longer < 0 ? "less" : "more", kCmPerM * kTrunkSd);
}

std::string pace_note(const BudgetConfig& budget) {
  return fmt::format(
      "not deterministic: {} to {} particles, as many as {:g} ms a frame allowed on this machine",
      budget.least_particles, budget.most_particles, budget.frame_ms);
}

std::vector<std::string> notes_of(const TrackJob& job, const TrackRun& run,
                                  const TrackOutcome& outcome) {
  std::vector<std::string> out;
  if (!outcome.message.empty()) out.push_back(outcome.message);
  out.insert(out.end(), outcome.checks.begin(), outcome.checks.end());
  if (is_paced(job)) out.push_back(pace_note(job.config.values.budget));
  for (const std::string& note : subject_notes(job.scene, run)) out.push_back(note);
  for (const std::string& note : run.notes()) out.push_back(note);
  return out;
}

RunNumbers numbers_of(const TrackJob& job, const TrackRun& run, const TrackedFrames& frames,
                      const TrackOutcome& outcome, const KineticsTotals& totals) {
  const FrameCounts counts = frame_counts(frames);
  const int out_of_picture = frames_out_of_picture(frames);
  RunNumbers out{{"frames", double(frames.records.size())},
                 {"frame_rate", frames.frame_rate},
                 {"video_seconds", double(frames.records.size()) / frames.frame_rate},
                 {"tracked_frames", double(counts.tracked)},
                 {"first_tracked_frame", double(counts.first)},
                 {"lost_frames", double(counts.lost - out_of_picture)},
                 {"out_of_picture_frames", double(out_of_picture)},
                 {"losses", double(run.losses())},
                 {"frames_beside_others", double(run.frames_beside_others())},
                 {"foot_changes", double(foot_changes(frames))},
                 {"fallen_particles", double(counts.fallen)},
                 {"diverged_particles", double(counts.diverged)},
                 {"simulated_percent", simulated_percent(frames)},
                 {"distance_m", totals.distance},
                 {"positive_work_j", totals.positive_work},
                 {"negative_work_j", totals.negative_work},
                 {"cost_of_transport", totals.cost_of_transport},
                 {"peak_foot_load_body_weights", totals.peak_load}};
  const auto [stature, girth, trunk] = run.estimates();
  if (stature) {
    out.emplace_back("estimated_height_m", stature->height);
    out.emplace_back("estimated_height_sd_m", stature->sd);
  }
  if (girth) out.emplace_back("estimated_girth", *girth);
  if (trunk) out.emplace_back("estimated_trunk_m", *trunk);
  if (outcome.lag) {
    out.emplace_back("lag_frames_" + job.scene.cameras[outcome.lag->camera].name,
                     outcome.lag->frames);
    out.emplace_back("lag_sd_frames", outcome.lag->sd_frames);
  }
  const std::vector<double> overlaps = mean_overlaps(fits_of(frames.records));
  for (size_t c = 0; c < overlaps.size(); ++c)
    out.emplace_back(overlap_key(job.scene.cameras[c]), 100 * overlaps[c]);
  for (const auto& number : keypoint_numbers(run.keypoints())) out.push_back(number);
  if (run.keypoints_lead()) out.emplace_back("keypoints_lead", 1);
  return out;
}

double mean_speed(const TrackedFrames& frames) {
  double sum = 0, count = 0;
  for (const double speed : pelvis_speeds(frames))
    if (std::isfinite(speed)) sum += speed, ++count;
  return count > 0 ? sum / count : 0;
}

RunSeries series_of(const TrackJob& job, const TrackRun& run, const TrackedFrames& frames) {
  RunSeries out{
      {"ess", by_frame(frames, [](const FrameRecord& r) { return r.filter.ess; })},
      {"log_evidence",
       by_frame(frames, [](const FrameRecord& r) { return r.filter.log_evidence; })},
      {"layers", by_frame(frames, [](const FrameRecord& r) { return double(r.filter.layers); })},
      {"jumped", by_frame(frames, [](const FrameRecord& r) { return r.history.jumped; })},
      {"caught", by_frame(frames, [](const FrameRecord& r) { return r.history.caught; })},
      {"left_stance",
       by_frame(frames, [](const FrameRecord& r) { return r.estimate.left_stance; })},
      {"stride_phase", by_frame(frames, [](const FrameRecord& r) { return r.modes.phase; })},
      {"legs_exchanged",
       by_frame(frames, [](const FrameRecord& r) { return r.modes.p_legs_swapped; })},
      {"standing", by_frame(frames, [](const FrameRecord& r) { return r.modes.standing; })},
      {"speed", pelvis_speeds(frames)}};
  add_evidence(job.scene, frames, out);
  for (size_t c = 0; c < job.scene.cameras.size(); ++c)
    out.emplace_back(overlap_key(job.scene.cameras[c]), overlap_percents(frames, c));
  for (auto& list :
       keypoint_residuals(frames, with_estimates(job.scene, run.estimates()), job.config.values))
    out.push_back(std::move(list));
  if (is_paced(job)) out.emplace_back("particles", run.particles_used());
  return out;
}

}  // namespace

FrameCounts frame_counts(const TrackedFrames& frames) {
  FrameCounts out;
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

std::vector<std::string> subject_notes(const Scene& scene, const TrackRun& run) {
  std::vector<std::string> out;
  const auto [stature, girth, trunk] = run.estimates();
  if (stature) out.push_back(size_note(scene, *stature));
  if (girth)
    out.push_back(fmt::format(
        "the outlines show that the subject's trunk and limbs are {:.2f} times as wide as usual, "
        "give or take {:.2f}; subject.yaml has it for other videos of the same person",
        *girth, kGirthSd));
  if (trunk) out.push_back(trunk_note(scene, *trunk));
  return out;
}

RunRecord record_of(const TrackJob& job, const Origin& inputs, const TrackRun& run,
                    const TrackedFrames& frames, const TrackOutcome& outcome,
                    const Quality& quality, const WrittenTables& tables, const Elapsed& spent) {
  RunRecord out;
  out.command = "track";
  out.scene = job.scene.file.filename().string();
  out.scene_digest = sha256(read_text_file(job.scene.file, kMaxSceneBytes));
  out.inputs = inputs;
  out.config = job.config;
  out.status = status_word(outcome.status);
  out.notes = notes_of(job, run, outcome);
  out.numbers = numbers_of(job, run, frames, outcome, tables.totals);
  const std::vector<KeypointTerm::State> keypoints = run.keypoints();
  out.constants = recording_constants(
      {job.scene, frames.frame_rate, mean_speed(frames), run.estimates(), outcome.lag, keypoints});
  out.quality = quality;
  out.by_frame = series_of(job, run, frames);
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

}  // namespace jobs
}  // namespace walktrack
