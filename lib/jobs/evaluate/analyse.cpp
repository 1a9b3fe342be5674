#include "jobs/evaluate/analyse.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "core/errors.h"
#include "io/archive/files.h"
#include "io/archive/run_record.h"
#include "io/archive/sha256.h"
#include "io/tables/motion_file.h"
#include "jobs/track/report/report.h"
#include "jobs/track/report/track_quality.h"
#include "metrics/joint_error.h"

namespace walktrack {
inline namespace jobs {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr size_t kMaxMotionBytes = size_t{1} << 30;

size_t whole_frames(const Motion& motion) {
  return static_cast<size_t>(
      std::count_if(motion.joints.begin(), motion.joints.end(), [](const JointPositions& joints) {
        return std::all_of(kScoredJoints.begin(), kScoredJoints.end(),
                           [&](Joint joint) { return known(joints[joint]); });
      }));
}

// Tracked joints are noisier than measured ones, so that their forces need the cut-off frequency
// for tracks.
bool was_tracked(const fs::path& motion) {
  return command_of_result(motion.parent_path()) == "track";
}

RunRecord record_of(const AnalyseJob& job, const fs::path& file, const AnalysedMotion& analysed,
                    const KineticsTotals& totals) {
  RunRecord record;
  record.command = "analyse";
  record.scene = file.filename().string();
  record.scene_digest = sha256(read_text_file(file, kMaxMotionBytes));
  record.config = job.config;
  record.status = "analysed";
  if (!job.mass)
    record.notes.emplace_back("the subject's mass is not known: forces are those of 70 kg");
  if (was_tracked(file))
    record.notes.emplace_back(
        "a tracked motion: forces are smoothed below kinetics.tracked_cutoff_hz");
  record.numbers = {{"frames", static_cast<double>(analysed.motion.time.size())},
                    {"tracked_frames", static_cast<double>(whole_frames(analysed.motion))},
                    {"height_m", analysed.subject.height},
                    {"mass_kg", analysed.subject.mass},
                    {"distance_m", totals.distance},
                    {"positive_work_j", totals.positive_work},
                    {"negative_work_j", totals.negative_work},
                    {"cost_of_transport", totals.cost_of_transport},
                    {"peak_foot_load_body_weights", totals.peak_load}};
  record.quality =
      quality_of_motion(analysed.motion, analysed.rate, leg_length(body_lengths(analysed.subject)));
  record.digest = record.scene_digest;
  record.command_line = job.command_line;
  return record;
}

}  // namespace

AnalyseOutcome analyse(const AnalyseJob& job) {
  const auto start = Clock::now();
  const fs::path file = fs::is_directory(job.motion) ? job.motion / "joints.csv" : job.motion;
  AnalysedMotion analysed;
  analysed.motion = read_motion(file);
  if (analysed.motion.time.size() < 2)
    throw InputError(describe({file.string(), 0, ""}, "fewer than two rows", "a motion"));
  analysed.rate = 1 / sample_period(analysed.motion);
  analysed.subject.height = job.height.value_or(stature_of(analysed.motion));
  analysed.subject.mass = job.mass.value_or(Subject{}.mass);
  analysed.angles = angle_rows(analysed.motion, body_lengths(analysed.subject));
  Outputs outputs{job.output, "analyse", motion_table_files(), {file}};
  outputs.files.emplace_back(kReportFile);
  const ResultFolder folder(outputs, job.overwrite);
  KineticsConfig forces = job.config.values.kinetics;
  if (was_tracked(file)) forces.cutoff_hz = forces.tracked_cutoff_hz;
  const KineticsTotals totals = write_motion_tables(analysed, forces, folder).forces;
  RunRecord record = record_of(job, file, analysed, totals);
  record.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  const std::string text = run_json(record);
  const fs::path report = write_report(folder, {file, analysed, {}, {}, text, {}});
  folder.finish(text);
  const Gait gait = gait_from_motion(analysed.motion);
  return {gait.steps.size(), gait.speed, report};
}

}  // namespace jobs
}  // namespace walktrack
