#include "jobs/evaluate/figures.h"

#include <cmath>
#include <limits>
#include <tuple>
#include <vector>

#include <fmt/format.h>

#include "core/conventions.h"
#include "kinetics/kinetics.h"
#include "metrics/angle_error.h"
#include "metrics/gait.h"
#include "metrics/joint_error.h"
#include "metrics/plausibility.h"

namespace walktrack {
inline namespace jobs {

namespace {

constexpr double kMm = 1000, kPercent = 100, kMs = 1000;
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kTrimFrames = 4;  // left out at either end of a flat-foot interval: heel strike
                                   // and heel-off

class Figures {
 public:
  void add(std::string key, std::string label, double value, int decimals) {
    list_.push_back({std::move(key), std::move(label), value, decimals});
  }
  void add_detail_mm(const std::string& key, double metres) {
    list_.push_back({key + "_mm", key + ", mm", kMm * metres, 1, true});
  }
  void add_mm(const std::string& key, const std::string& label, double metres) {
    add(key + "_mm", label + ", mm", kMm * metres, 1);
  }
  void add_share(const std::string& key, const std::string& label, double share) {
    add(key + "_percent", label + ", %", kPercent * share, 1);
  }
  std::vector<Figure> take() { return std::move(list_); }

 private:
  std::vector<Figure> list_;
};

void add_joint_errors(const Motion& truth, const Motion& estimate, Figures& out) {
  const JointErrors e = joint_errors(truth, estimate);
  const bool any = e.frames > 0;
  out.add("initialised_at_s", "initialised at, s", e.start, 2);
  out.add_share("filled", "frames filled after that", e.filled_share);
  out.add_mm("joint_error_mean", "joint error (7 joints), mean", any ? e.absolute.mean : kNone);
  out.add_mm("joint_error_median", "joint error, median", any ? e.absolute.median : kNone);
  out.add_mm("joint_error_p95", "joint error, 95 %", any ? e.absolute.p95 : kNone);
  out.add_mm("joint_error_relative", "joint error, pelvis moved onto truth",
             any ? e.pelvis_relative.mean : kNone);
  out.add_mm("joint_error_procrustes", "joint error, Procrustes", any ? e.procrustes.mean : kNone);
  out.add_mm("offset_along", "pelvis ahead of the truth, mean", e.mean_offset.x());
  out.add_mm("offset_left", "pelvis to the left of it, mean", e.mean_offset.y());
  out.add_mm("offset_up", "pelvis above it, mean", e.mean_offset.z());
  out.add("leg_length_percent", "legs longer than the truth's, %",
          kPercent * (e.leg_length_ratio - 1), 1);
  out.add_share("swapped", "frames with legs swapped", any ? e.swapped_share : kNone);
  for (size_t j = 0; j < kJointCount; ++j) {
    const std::string name(kJointNames[j]);
    const JointErrors::OfJoint& joint = e.by_joint[j];
    const auto mean = [](const ErrorStatistics& of) { return of.count > 0 ? of.mean : kNone; };
    out.add_mm("error_" + name, "  " + name, mean(joint.absolute));
    out.add_detail_mm("error_relative_" + name, mean(joint.pelvis_relative));
    out.add_detail_mm("error_procrustes_" + name, mean(joint.procrustes));
  }
}

void add_angle_errors(const Motion& truth, const Motion& estimate, Figures& out) {
  const auto errors = angle_errors(truth, estimate);
  for (size_t i = 0; i < kAngleCount; ++i) {
    const std::string name(kAngleNames[i]);
    const bool any = errors[i].count > 0;
    out.add("angle_" + name + "_rms_deg", name + " error, rms, deg",
            any ? deg_from_rad(errors[i].rms) : kNone, 1);
    out.add("angle_" + name + "_bias_deg", "  its mean, deg",
            any ? deg_from_rad(errors[i].bias) : kNone, 1);
  }
}

void add_gait(const std::string& prefix, const std::string& of, const Gait& gait, Figures& out) {
  const bool steps = !gait.steps.empty();
  out.add(prefix + "speed_m_s", "speed" + of + ", m/s", gait.speed, 3);
  out.add(prefix + "step_length_m", "mean step" + of + ", m", steps ? gait.mean_step_length : kNone,
          3);
  out.add(prefix + "step_time_s", "mean step time" + of + ", s",
          gait.mean_step_time > 0 ? gait.mean_step_time : kNone, 3);
  out.add(prefix + "step_width_m", "mean step width" + of + ", m",
          steps ? gait.mean_step_width : kNone, 3);
  out.add(prefix + "steps", "steps" + of, static_cast<double>(gait.steps.size()), 0);
}

void add_gait_errors(const Gait& truth, const Gait& estimate, Figures& out) {
  add_gait("truth_", " of the truth", truth, out);
  const auto add_error = [&](const char* key, const char* label, double found, double expected) {
    out.add(key, label, found > 0 && expected > 0 ? found - expected : kNone, 3);
  };
  add_error("speed_error_m_s", "speed, error, m/s", estimate.speed, truth.speed);
  add_error("step_length_error_m", "mean step, error, m", estimate.mean_step_length,
            truth.mean_step_length);
  add_error("step_time_error_s", "mean step time, error, s", estimate.mean_step_time,
            truth.mean_step_time);
  if (!truth.steps.empty() && !estimate.steps.empty())
    out.add("step_width_error_m", "mean step width, error, m",
            estimate.mean_step_width - truth.mean_step_width, 3);
  const EventErrors events = event_errors(truth.events, estimate.events);
  const bool any = events.matched > 0;
  out.add("event_error_ms", "gait events, mean absolute error, ms",
          any ? kMs * events.mean_absolute : kNone, 0);
  out.add("event_late_ms", "gait events, mean late, ms", any ? kMs * events.mean_late : kNone, 0);
  out.add("events_missed", "gait events missed", static_cast<double>(events.missed), 0);
  out.add("events_extra", "gait events invented", static_cast<double>(events.extra), 0);
}

void add_plausibility(const Motion& estimate, const Gait& gait, Figures& out) {
  const Plausibility p = plausibility(estimate, gait);
  out.add_mm("foot_slide_mean", "foot slide in stance, mean",
             p.stances > 0 ? p.mean_foot_slide : kNone);
  out.add_mm("foot_slide_worst", "foot slide in stance, worst",
             p.stances > 0 ? p.worst_foot_slide : kNone);
  out.add_mm("penetration", "deepest foot joint below ground", p.penetration);
  out.add("jitter_m_s3", "jitter (mean jerk), m/s^3", p.jitter, 0);
}

// Coverage of the 5-95 % intervals by group of joints and direction.
void add_coverage_by_group(const CoverageReport& report, Figures& out) {
  struct Group {
    std::string_view key, label;
    std::vector<Joint> joints;
  };
  const Group groups[] = {{"pelvis", "pelvis", {Joint::kPelvis}},
                          {"neck", "neck", {Joint::kNeck}},
                          {"head", "head", {Joint::kHead}},
                          {"hips", "hips", {Joint::kLeftHip, Joint::kRightHip}},
                          {"knees", "knees", {Joint::kLeftKnee, Joint::kRightKnee}},
                          {"ankles", "ankles", {Joint::kLeftAnkle, Joint::kRightAnkle}},
                          {"toes", "toes", {Joint::kLeftToe, Joint::kRightToe}}};
  for (const Group& group : groups) {
    for (const auto& [direction, key, label] :
         {std::tuple{Direction::kLevel, "level", "over the ground"},
          {Direction::kUp, "up", "upwards"}}) {
      std::vector<Coverage> parts;
      for (const Joint joint : group.joints) parts.push_back(report.of(joint, direction));
      const Coverage both = joined(parts);
      out.add_share(fmt::format("coverage90_{}_{}", group.key, key),
                    fmt::format("  {}, {}", group.label, label),
                    both.count > 0 ? both.share : kNone);
    }
  }
}

void add_coverage(const CoverageReport& report, Figures& out) {
  const bool any = report.scored.count > 0;
  out.add_share("coverage90", "truth inside the 5-95 % interval",
                any ? report.scored.share : kNone);
  add_coverage_by_group(report, out);
  out.add_mm("interval_width", "mean width of that interval",
             any ? report.scored.mean_width : kNone);
  out.add("calibration_error", "calibration error of all intervals (ECE)",
          any ? calibration_error(report.scored) : kNone, 3);
}

void add_truth(const Motion& truth, const Motion& estimate, const Gait& gait, Figures& out) {
  add_joint_errors(truth, estimate, out);
  add_angle_errors(truth, estimate, out);
  add_gait_errors(gait_from_motion(truth), gait, out);
}

void add_truth(const std::vector<FootPlant>& truth, const Motion& estimate, const Gait&,
               Figures& out) {
  const double frame = estimate.time.size() < 2 ? 0 : sample_period(estimate);
  const FootPlantErrors e = foot_plant_errors(truth, estimate, kTrimFrames * frame);
  out.add("plants", "foot plants", static_cast<double>(truth.size()), 0);
  out.add("plants_found", "found, on their side", static_cast<double>(e.found), 0);
  out.add_mm("plant_error_mean", "foot error over stances, mean", e.mean_error);
  for (size_t i = 0; i < e.plants.size(); ++i) {
    const char* side = truth[i].side == Side::kLeft ? "left" : "right";
    out.add_mm(fmt::format("plant{}_error", i), fmt::format("  plant {} ({})", i, side),
               e.plants[i].error);
  }
  if (truth.size() < 2) return;
  const double way = std::abs(truth.back().place - truth.front().place);
  out.add("truth_step_length_m", "mean step of the truth, m",
          way / static_cast<double>(truth.size() - 1), 3);
  out.add("truth_speed_m_s", "speed of the truth, first to last strike, m/s",
          way / (truth.back().on - truth.front().on), 3);
}

void add_truth(const GroundPoints& truth, const Motion& estimate, const Gait&, Figures& out) {
  const GroundErrors e = ground_errors(truth, estimate);
  const bool any = e.distance.count > 0;
  out.add_share("filled", "frames filled after initialisation", e.filled_share);
  out.add_mm("ground_error_median", "ground error, median", any ? e.distance.median : kNone);
  out.add_mm("ground_error_mean", "ground error, mean", any ? e.distance.mean : kNone);
  out.add_mm("ground_error_p95", "ground error, 95 %", any ? e.distance.p95 : kNone);
  out.add_mm("ground_error_worst", "ground error, worst", any ? e.distance.worst : kNone);
}

}  // namespace

std::vector<Figure> figures(const Truth& truth, const Motion& estimate,
                            const std::optional<JointUncertainty>& uncertainty) {
  Figures out;
  const Gait gait = gait_from_motion(estimate);
  std::visit([&](const auto& known_truth) { add_truth(known_truth, estimate, gait, out); }, truth);
  add_gait("", "", gait, out);
  add_plausibility(estimate, gait, out);
  if (const Motion* joints = std::get_if<Motion>(&truth); joints && uncertainty)
    add_coverage(coverage(*joints, *uncertainty), out);
  return out.take();
}

std::vector<Figure> force_figures(const GroundForces& truth, const GroundForces& estimate) {
  const double cutoff = KineticsConfig{}.cutoff_hz;
  const ForceErrors e = force_errors(truth, estimate, cutoff);
  const std::string below = fmt::format(" below {:g} Hz, rms, N", cutoff);
  Figures out;
  out.add("force_vertical_rms_n", "vertical ground force" + below,
          e.count > 0 ? e.vertical_rms : kNone, 0);
  out.add("force_horizontal_rms_n", "horizontal ground force" + below,
          e.count > 0 ? e.horizontal_rms : kNone, 0);
  return out.take();
}

}  // namespace jobs
}  // namespace walktrack
