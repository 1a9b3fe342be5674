#include "jobs/track/results/track_results.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "io/archive/run_record.h"
#include "io/tables/motion_file.h"
#include "jobs/track/report/report.h"
#include "jobs/track/results/overlay_video.h"
#include "jobs/track/track_run.h"
#include "tracker/smooth/model_error.h"

namespace walktrack {
inline namespace jobs {

namespace {

double time_of(const TrackedFrames& frames, size_t i) {
  return static_cast<double>(i) / frames.frame_rate;
}

std::vector<AngleRow> angles_of(const TrackedFrames& frames) {
  std::vector<AngleRow> rows;
  for (size_t i = 0; i < frames.records.size(); ++i) {
    AngleRow& row = rows.emplace_back(AngleRow{time_of(frames, i), {}, {}, {}});
    const FrameEstimate& estimate = frames.records[i].estimate;
    if (!frames.records[i].tracked) continue;
    row.pose = estimate.pose;
    row.p05.emplace();
    row.p95.emplace();
    for (size_t k = 0; k < kJointAngleCount; ++k) {
      (*row.p05)[k] = estimate.angles[k].p05;
      (*row.p95)[k] = estimate.angles[k].p95;
    }
  }
  return rows;
}

struct Stretch {
  size_t first = 0, count = 0;  // frames
};

// The longest one that was tracked without a gap.
Stretch longest_stretch(const Motion& motion) {
  Stretch now, longest;
  for (size_t i = 0; i < motion.joints.size(); ++i) {
    now = known(motion.joints[i][Joint::kPelvis]) ? Stretch{now.first, now.count + 1}
                                                  : Stretch{i + 1, 0};
    if (now.count > longest.count) longest = now;
  }
  return longest;
}

// Where the walker is halfway through the longest stretch. Between two passes of a walkway they are
// at the edge of the picture, where an error of the figure is not seen.
FigureError figure_error_of(const Motion& motion, const Scene& scene) {
  const Stretch stretch = longest_stretch(motion);
  if (stretch.count == 0) return {};
  const JointPositions& joints = motion.joints[stretch.first + stretch.count / 2];
  std::vector<Camera> cameras;
  for (const SceneCamera& each : scene.cameras) cameras.push_back(each.camera);
  const Eigen::Vector3d pelvis = joints[Joint::kPelvis];
  const Eigen::Matrix3d covariance =
      figure_covariance(cameras, joints[Joint::kHead],
                        0.5 * (joints[Joint::kLeftAnkle] + joints[Joint::kRightAnkle]));
  const auto sd_along = [&](const Eigen::Vector3d& way) {
    return std::sqrt(way.dot(covariance * way));
  };
  FigureError out{std::numeric_limits<double>::infinity(), 0};
  for (const Camera& camera : cameras) {
    const Eigen::Vector3d ray = pelvis - camera_centre(camera);
    out.scale = std::min(out.scale, sd_along(ray.normalized()) / ray.norm());
  }
  const Eigen::Vector3d way = motion.joints[stretch.first + stretch.count - 1][Joint::kPelvis] -
                              motion.joints[stretch.first][Joint::kPelvis];
  out.across = sd_along(Eigen::Vector3d::UnitZ().cross(way).stableNormalized());
  return out;
}

// Whether the walker's supporting side has a meaning: a subject who stands does so on both feet.
bool walks(const FrameRecord& record) { return record.tracked && record.modes.standing < 0.5; }

}  // namespace

Motion motion_of(const TrackedFrames& frames) {
  Motion motion;
  for (size_t i = 0; i < frames.records.size(); ++i) {
    motion.time.push_back(time_of(frames, i));
    motion.joints.push_back(unknown_joints());
    const FrameRecord& record = frames.records[i];
    if (!record.tracked) continue;
    for (size_t j = 0; j < record.estimate.joint_count; ++j)
      motion.joints.back().at[j] = record.estimate.joints.at[j];
  }
  return motion;
}

JointUncertainty uncertainty_of(const TrackedFrames& frames) {
  JointUncertainty out;
  for (size_t i = 0; i < frames.records.size(); ++i) {
    out.time.push_back(time_of(frames, i));
    for (auto* column : {&out.sd, &out.p05, &out.p95}) column->push_back(unknown_joints());
    const FrameRecord& record = frames.records[i];
    for (size_t j = 0; record.tracked && j < record.estimate.joint_count; ++j) {
      for (Eigen::Index axis = 0; axis < 3; ++axis) {
        const Spread& spread = record.estimate.spread[j][static_cast<size_t>(axis)];
        out.sd.back().at[j][axis] = spread.sd;
        out.p05.back().at[j][axis] = spread.p05;
        out.p95.back().at[j][axis] = spread.p95;
      }
    }
  }
  return out;
}

Ensemble ensemble_of(const TrackedFrames& frames) {
  Ensemble out;
  for (const FrameRecord& record : frames.records) {
    if (record.tracked) out.size = record.samples.size();
  }
  out.member = [&frames](size_t m) {
    Motion motion;
    for (const FrameRecord& record : frames.records) {
      motion.time.push_back(time_of(frames, motion.time.size()));
      motion.joints.push_back(unknown_joints());
      for (size_t j = 0; record.tracked && j < record.estimate.joint_count; ++j)
        motion.joints.back().at[j] = record.samples[m].at[j];
    }
    return motion;
  };
  return out;
}

std::vector<SupportTransfer> support_transfers_of(const TrackedFrames& frames) {
  // The transfer is dated some frames after it, when the images have told the particles apart.
  constexpr double kHindsight = 0.1;  // s
  const auto later = static_cast<size_t>(std::lround(kHindsight * frames.frame_rate));
  struct Support {
    bool tracked, left;
    Spread since;
  };
  std::vector<Support> support;
  for (const FrameRecord& record : frames.records)
    support.push_back(
        {walks(record), record.estimate.left_stance > 0.5, record.estimate.since_transfer});
  std::vector<SupportTransfer> out;
  for (size_t i = 1; i < support.size(); ++i) {
    if (!support[i].tracked || !support[i - 1].tracked) continue;
    if (support[i].left == support[i - 1].left) continue;
    size_t at = i;
    while (at < i + later && at + 1 < support.size() && support[at + 1].tracked &&
           support[at + 1].left == support[i].left)
      ++at;
    const Spread& since = support[at].since;
    const double now = time_of(frames, at);
    // Few particles with another history pull the mean out of their own band.
    const double usual = std::clamp(since.mean, since.p05, since.p95);
    out.push_back({support[i].left ? Side::kLeft : Side::kRight,
                   {now - usual, now - since.p95, now - since.p05}});
  }
  return out;
}

Outputs track_outputs(const TrackJob& job) {
  Outputs out{job.output, "track", motion_table_files(), files_of(job.scene)};
  out.files.insert(out.files.end(), {"joints.csv", "uncertainty.csv", kSubjectFile, kReportFile});
  out.files.insert(out.files.end(), kPassingFiles.begin(), kPassingFiles.end());
  for (const SceneCamera& camera : job.scene.cameras)
    if (job.overlay) out.files.push_back(overlay_name(camera));
  return out;
}

Scene with_estimates(const Scene& scene, const SubjectEstimates& estimates) {
  Scene out = scene;
  Subject& subject = out.subject;
  if (estimates.girth) subject.girth = *estimates.girth;
  if (estimates.trunk) subject.lengths.trunk = estimates.trunk;
  if (!estimates.stature) return out;
  const double ratio = estimates.stature->height / scene.subject.height;
  subject.height = estimates.stature->height;
  if (!scene.mass_given) subject.mass *= ratio * ratio;
  return out;
}

StatedSubject known_subject(const Scene& scene, const SubjectEstimates& estimates) {
  StatedSubject out{.subject = with_estimates(scene, estimates).subject,
                    .height_sd = scene.height_sd,
                    .height_stated = scene.height_given || scene.height_sd || estimates.stature,
                    .mass_stated = scene.mass_given,
                    .girth_stated = scene.girth_given || estimates.girth,
                    .file = {}};
  if (estimates.stature) out.height_sd = estimates.stature->sd;
  return out;
}

AnalysedMotion analysed_motion(const TrackedFrames& frames, const Scene& scene,
                               double model_error) {
  const Motion motion = motion_of(frames);
  return {motion,
          ensemble_of(frames),
          support_transfers_of(frames),
          angles_of(frames),
          frames.frame_rate,
          scene.subject,
          scene.gravity,
          scene.world,
          figure_error_of(motion, scene),
          model_error};
}

WrittenTables write_tables(const AnalysedMotion& analysed, const JointUncertainty& uncertainty,
                           const KineticsConfig& config, const ResultFolder& folder) {
  const std::string joints = motion_csv(analysed.motion, analysed.world);
  const std::string bands = uncertainty_csv(analysed.motion, uncertainty, analysed.world);
  folder.write("joints.csv", joints);
  folder.write("uncertainty.csv", bands);
  const TableTotals totals = write_motion_tables(analysed, config, folder);
  return {result_digest(joints, bands), totals.forces, totals.walk};
}

int foot_changes(const TrackedFrames& frames) {
  int changes = 0;
  bool before_left = false, known_before = false;
  for (const FrameRecord& record : frames.records) {
    const bool left = record.estimate.left_stance > 0.5;
    if (walks(record) && known_before && left != before_left) ++changes;
    known_before = walks(record);
    before_left = left;
  }
  return changes;
}

}  // namespace jobs
}  // namespace walktrack
