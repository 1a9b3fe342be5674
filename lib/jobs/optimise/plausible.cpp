#include "jobs/optimise/plausible.h"

#include <cmath>

#include <fmt/format.h>

#include "core/conventions.h"
#include "kinetics/gait_contacts.h"
#include "metrics/plausibility.h"

namespace walktrack {
inline namespace jobs {

namespace {

// Root mean square, of what has been added.
class Rms {
 public:
  void add(double value) {
    sum_ += value * value;
    ++count_;
  }
  double value() const { return count_ > 0 ? std::sqrt(sum_ / count_) : 0; }

 private:
  double sum_ = 0;
  int count_ = 0;
};

struct Forces {
  double torque = 0;           // N m, rms of hips' and knees' flexion and ankles
  double torque_rate = 0;      // N m / s, rms of their change
  double outside_percent = 0;  // frames whose ground force feet and floor cannot transmit
};

std::array<double, 6> torques(const KineticsFrame& frame) {
  const auto& [left, right] = frame.legs;
  return {left.hip_flexion,  left.knee_flexion,  left.ankle_dorsiflexion,
          right.hip_flexion, right.knee_flexion, right.ankle_dorsiflexion};
}

// Whether soles on a floor can transmit a force: they do not pull, and the friction cone has it.
bool transmissible(const Eigen::Vector3d& force) {
  return force.z() >= 0 && force.head<2>().norm() <= kFriction * force.z();
}

Forces forces_of(const Motion& motion, const Gait& gait, const Subject& subject,
                 const Eigen::Vector3d& gravity, const KineticsConfig& config) {
  const Kinetics kinetics = kinetics_of(motion, foot_contacts(gait), subject, gravity, config);
  Rms torque, rate;
  int known = 0, outside = 0;
  for (size_t i = 0; i < kinetics.frames.size(); ++i) {
    const KineticsFrame& frame = kinetics.frames[i];
    if (!frame.known) continue;
    ++known;
    outside += transmissible(frame.ground.force) ? 0 : 1;
    const auto now = torques(frame);
    for (const double each : now) torque.add(each);
    if (i == 0 || !kinetics.frames[i - 1].known) continue;
    const auto before = torques(kinetics.frames[i - 1]);
    for (size_t k = 0; k < now.size(); ++k)
      rate.add((now[k] - before[k]) / (kinetics.time[i] - kinetics.time[i - 1]));
  }
  return {torque.value(), rate.value(), known > 0 ? 100.0 * outside / known : 0};
}

}  // namespace

std::vector<Change> changes_of(const Motion& before, const Motion& after, const Subject& subject,
                               const Eigen::Vector3d& gravity, const KineticsConfig& config) {
  const Gait gait_before = gait_from_motion(before), gait_after = gait_from_motion(after);
  const Plausibility a = plausibility(before, gait_before), b = plausibility(after, gait_after);
  const Forces f = forces_of(before, gait_before, subject, gravity, config),
               g = forces_of(after, gait_after, subject, gravity, config);
  constexpr double kMm = 1000;
  return {
      {"foot_slide_mean_mm", "slide of standing feet, mean, mm", kMm * a.mean_foot_slide,
       kMm * b.mean_foot_slide, 1},
      {"foot_slide_worst_mm", "slide of standing feet, worst, mm", kMm * a.worst_foot_slide,
       kMm * b.worst_foot_slide, 1},
      {"penetration_mm", "deepest foot below the floor, mm", kMm * a.penetration,
       kMm * b.penetration, 1},
      {"jitter_m_s3", "jitter of the joints, m/s^3", a.jitter, b.jitter, 0},
      {"torque_nm", "torque of hips, knees and ankles, rms, N m", f.torque, g.torque, 1},
      {"torque_rate_nm_s", "change of these torques, rms, N m/s", f.torque_rate, g.torque_rate, 0},
      {"force_outside_percent", "frames whose ground force no floor can transmit, %",
       f.outside_percent, g.outside_percent, 1},
  };
}

std::string changes_text(const std::vector<Change>& changes) {
  std::string out = fmt::format("{:<50} {:>9} {:>9}\n", "", "before", "after");
  for (const Change& each : changes)
    out += fmt::format("{:<50} {:>9.{}f} {:>9.{}f}\n", each.what, each.before, each.digits,
                       each.after, each.digits);
  return out;
}

}  // namespace jobs
}  // namespace walktrack
