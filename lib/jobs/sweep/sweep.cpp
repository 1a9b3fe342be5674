#include "jobs/sweep/sweep.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <numeric>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/errors.h"
#include "core/parallel_for.h"
#include "io/archive/files.h"
#include "io/archive/result_folder.h"
#include "io/tables/motion_file.h"
#include "io/video/scene_video.h"
#include "jobs/evaluate/evaluate.h"
#include "jobs/track/track.h"
#include "jobs/track/track_origin.h"
#include "metrics/joint_error.h"
#include "metrics/statistics/pareto.h"
#include "metrics/statistics/statistics.h"

namespace walktrack {
inline namespace jobs {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr double kNoResult = std::numeric_limits<double>::quiet_NaN();
constexpr size_t kMaxBytes = size_t{1} << 28;
constexpr size_t kMostRuns = 100'000;
constexpr const char* kJoints = "joints.csv";

// The main error of `evaluate` for each kind of truth.
constexpr std::array<std::string_view, 3> kHeadlines{"joint_error_mean_mm", "plant_error_mean_mm",
                                                     "ground_error_mean_mm"};

// A name that is valid on any file system.
std::string folder_name(const std::string& setting) {
  std::string name = setting.empty() ? "as configured" : setting;
  for (char& c : name) {
    const bool safe = std::isalnum(static_cast<unsigned char>(c)) != 0 ||
                      std::string_view("=+-._").find(c) != std::string_view::npos;
    if (!safe) c = '_';
  }
  return name;
}

// One run of the tracker within a sweep.
struct SweepTrial {
  const SweepSetting& setting;
  uint64_t seed;
  int repeat;  // counted from 0
};

class Sweep {
 public:
  Sweep(const SweepJob& job, const JobControl& control) : job_(job), control_(control) {
    const SceneVideo video(job.scene);
    frame_rate_ = video.frame_rate();
    frames_ = static_cast<size_t>(std::max(1, video.frame_count()));
  }

  size_t frames() const { return frames_; }
  double frame_rate() const { return frame_rate_; }
  void expect(size_t runs) { total_ = runs * frames_; }

  fs::path folder(const SweepTrial& trial) const {
    const std::string seed = fmt::format("seed_{}", trial.seed);
    return job_.output / "runs" / folder_name(setting_name(job_.parameters, trial.setting)) /
           (trial.repeat == 0 ? seed : fmt::format("{}_again_{}", seed, trial.repeat));
  }

  // Tracks unless the result exists; returns false if it was interrupted.
  bool run(const SweepTrial& trial) {
    const size_t before = done_;
    done_ += frames_;
    if (control_.stopping()) return false;
    const TrackJob track = track_job(trial);
    if (job_.again || !measured(track)) {
      const TrackOutcome outcome = track_scene(track, quiet(before));
      if (outcome.status == TrackStatus::kInterrupted) return false;
      if (outcome.status == TrackStatus::kCutShort)
        throw InputError(fmt::format("{}: {}", job_.scene.file.string(), outcome.message));
    }
    control_.progress("sweeping", done_, total_);
    return true;
  }

  Json record(const SweepTrial& trial) const {
    return Json::parse(read_text_file(folder(trial) / "run.json", kMaxBytes));
  }
  Motion joints(const SweepTrial& trial) const { return read_motion(folder(trial) / kJoints); }

 private:
  TrackJob track_job(const SweepTrial& trial) const {
    TrackJob track;
    track.scene = job_.scene;
    track.config = job_.config;
    apply_sweep_setting(job_.parameters, trial.setting, track.scene, track.config);
    track.config.values.seed = trial.seed;
    track.output = folder(trial);
    track.overwrite = true;
    track.overlay = false;
    track.command_line = {"walktrack", "sweep"};
    return track;
  }

  // Whether the run's folder contains the result that this program would compute now.
  bool measured(const TrackJob& track) const {
    // A part of it may have been removed.
    if (!is_complete_result(track.output) || !fs::exists(track.output / kJoints)) return false;
    const std::string changed =
        changes_since(track.output, origin_of_track(track.scene, track.config));
    if (changed.empty()) return true;
    throw UsageError(
        fmt::format("{} holds a run with other settings or inputs ({}); -y measures all runs again",
                    track.output.string(), changed));
  }

  // The progress of a run is a part of the sweep's; its messages are left to its own report.
  JobControl quiet(size_t before) const {
    JobControl inner;
    inner.stop_request = control_.stop_request;
    inner.report = [this, before](const Progress& progress) {
      if (progress.what == "tracking")
        control_.progress("sweeping", before + std::min(progress.done, frames_), total_);
    };
    return inner;
  }

  const SweepJob& job_;
  const JobControl& control_;
  double frame_rate_ = 0;
  size_t frames_ = 0, done_ = 0, total_ = 0;  // frames of one run; of all runs
};

double median_or_none(std::vector<double> values) {
  return values.empty() ? kNoResult : quantile(std::move(values), 0.5);
}

// `clock`: stage_seconds or stage_cpu_seconds.
double tracking_seconds(const Json& record, const char* clock) {
  double seconds = 0;
  for (const auto& [stage, value] : record.at("timing").at(clock).items())
    if (stage != "background" && stage != "output") seconds += value.get<double>();
  return seconds;
}

// The main error; NaN if the subject was not found. Sets `label` to its name.
double headline(const Truth& truth, const Motion& estimate, std::string& label) {
  for (const Figure& figure : figures(truth, estimate, std::nullopt)) {
    if (std::find(kHeadlines.begin(), kHeadlines.end(), figure.key) == kHeadlines.end()) continue;
    label = figure.label;
    return figure.value;
  }
  return kNoResult;
}

SweepRun measure(const Sweep& sweep, const SweepTrial& trial, int repeats, const Truth& truth,
                 std::string& label) {
  SweepRun out;
  out.seed = trial.seed;
  const Json record = sweep.record(trial);
  const Json& numbers = record.at("numbers");
  const double frames = numbers.at("frames"), first = numbers.at("first_tracked_frame");
  out.found = first >= 0;
  if (out.found) {
    out.lost_share = numbers.at("lost_frames").get<double>() / (frames - first);
    out.error_mm = headline(truth, sweep.joints(trial), label);
  }
  std::vector<double> seconds, cpu_seconds;
  for (int repeat = 0; repeat < repeats; ++repeat) {
    const Json again = sweep.record({trial.setting, trial.seed, repeat});
    seconds.push_back(tracking_seconds(again, "stage_seconds") / frames);
    cpu_seconds.push_back(tracking_seconds(again, "stage_cpu_seconds") / frames);
  }
  out.seconds_per_frame = median_or_none(std::move(seconds));
  out.cpu_seconds_per_frame = median_or_none(std::move(cpu_seconds));
  return out;
}

// The truth or what replaces it; nullopt if interrupted.
std::optional<Truth> reference_of(const SweepJob& job, Sweep& sweep, const SweepSetting& richest,
                                  SweepReport& report) {
  const fs::path file = job.truth.empty() ? job.scene.truth : job.truth;
  if (!file.empty()) {
    report.reference = file.filename().string();
    return read_truth(file, sweep.frame_rate());
  }
  const SweepTrial trial{richest, job.config.values.seed + static_cast<uint64_t>(job.seeds), 0};
  report.against_truth = false;
  report.reference =
      fmt::format("a run of {} with seed {}", setting_name(job.parameters, richest), trial.seed);
  if (!sweep.run(trial)) return std::nullopt;
  Motion motion = sweep.joints(trial);
  const bool any = std::any_of(motion.joints.begin(), motion.joints.end(), scored_joints_known);
  if (!any)
    throw InputError(
        fmt::format("{}: errors cannot be measured: there is no truth, and {} found nobody",
                    job.scene.file.string(), report.reference));
  return motion;
}

}  // namespace

SweepReport run_sweep(const SweepJob& job, const JobControl& control) {
  refuse_what_is_not_ours(sweep_outputs(job));
  if (job.config.values.budget.frame_ms > 0)
    throw UsageError("budget.frame_ms: a sweep measures settings as they are; leave it 0");
  SweepReport report;
  report.scene = job.scene.file.filename().string();
  report.parameters = job.parameters;
  report.seeds = job.seeds;
  report.threads = thread_count(job.config.values.threads);
  const std::vector<SweepSetting> grid = sweep_grid(job.parameters);
  const size_t runs =
      grid.size() * static_cast<size_t>(job.seeds) * static_cast<size_t>(job.repeats);
  if (runs > kMostRuns)
    throw UsageError(
        describe({}, fmt::format("a grid of {} runs", runs), fmt::format("at most {}", kMostRuns)));
  Sweep sweep(job, control);
  const bool truth_known = !job.truth.empty() || !job.scene.truth.empty();
  sweep.expect(runs + (truth_known ? 0 : 1));
  const SweepSetting richest = richest_setting(job.parameters);
  const std::optional<Truth> truth = reference_of(job, sweep, richest, report);
  std::vector<SweepRow> rows;
  for (const SweepSetting& setting : grid) rows.push_back({setting, {}});
  for (int s = 0; truth && s < job.seeds && !report.interrupted; ++s) {
    for (SweepRow& row : rows) {
      const uint64_t seed = job.config.values.seed + static_cast<uint64_t>(s);
      int done = 0;
      while (done < job.repeats && sweep.run({row.setting, seed, done})) ++done;
      report.interrupted = done < job.repeats;
      if (report.interrupted) break;
      row.runs.push_back(
          measure(sweep, {row.setting, seed, 0}, job.repeats, *truth, report.error_is));
    }
  }
  report.interrupted = report.interrupted || !truth;
  std::erase_if(rows, [](const SweepRow& row) { return row.runs.empty(); });
  summarise_sweep(rows, job.config.values.quality.lost_share);
  report.rows = std::move(rows);
  return report;
}

void summarise_sweep(std::vector<SweepRow>& rows, double most_lost_share) {
  std::vector<Trade> trades;
  for (SweepRow& row : rows) {
    std::vector<double> errors, seconds, cpu_seconds;
    row.lost_share = 0;
    row.holds = !row.runs.empty();
    for (const SweepRun& run : row.runs) {
      if (run.found) errors.push_back(run.error_mm);
      seconds.push_back(run.seconds_per_frame);
      cpu_seconds.push_back(run.cpu_seconds_per_frame);
      row.lost_share += run.lost_share / static_cast<double>(row.runs.size());
      row.holds = row.holds && run.found && run.lost_share <= most_lost_share;
    }
    const auto n = static_cast<double>(errors.size());
    row.error_mm = errors.empty() ? kNoResult : std::reduce(errors.begin(), errors.end()) / n;
    double squares = 0;
    for (const double error : errors) squares += std::pow(error - row.error_mm, 2);
    row.error_sd_mm = errors.size() > 1 ? std::sqrt(squares / (n - 1)) : kNoResult;
    row.seconds_per_frame = median_or_none(std::move(seconds));
    row.cpu_seconds_per_frame = median_or_none(std::move(cpu_seconds));
    trades.push_back({row.seconds_per_frame, row.holds ? row.error_mm : kNoResult});
  }
  const std::vector<bool> front = pareto_front(trades);
  for (size_t i = 0; i < rows.size(); ++i) rows[i].on_front = front[i];
}

}  // namespace jobs
}  // namespace walktrack
