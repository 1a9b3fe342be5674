#include "metrics/references.h"

#include <cmath>

#include "metrics/gait.h"
#include "metrics/joint_error.h"

namespace walktrack {
inline namespace metrics {

namespace {

constexpr double kFoundWithin = 0.25;  // m; a third of a usual step
constexpr double kSameInstant = 1e-4;  // s; times come from frame numbers with a few decimals

// Mean |x - place| of that foot over [on, off]; NaN if it is never known.
double mean_offset(const Motion& motion, Side side, double place, double on, double off) {
  double sum = 0;
  size_t count = 0;
  for (size_t i = 0; i < motion.time.size(); ++i) {
    if (motion.time[i] < on - kSameInstant || motion.time[i] > off + kSameInstant) continue;
    const Eigen::Vector3d foot = foot_point(motion.joints[i], side);
    if (!known(foot)) continue;
    sum += std::abs(foot.x() - place);
    ++count;
  }
  return count > 0 ? sum / static_cast<double>(count) : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

FootPlantErrors foot_plant_errors(const std::vector<FootPlant>& truth, const Motion& estimate,
                                  double trim) {
  FootPlantErrors out;
  double sum = 0;
  size_t scored = 0;
  for (const FootPlant& plant : truth) {
    FootPlantError score;
    score.error = mean_offset(estimate, plant.side, plant.place, plant.on + trim, plant.off - trim);
    const double whole = mean_offset(estimate, plant.side, plant.place, plant.on, plant.off);
    const double others =
        mean_offset(estimate, other(plant.side), plant.place, plant.on, plant.off);
    const double own = std::isnan(score.error) ? whole : score.error;
    score.found = own <= kFoundWithin && !(others <= whole);
    if (score.found) ++out.found;
    if (!std::isnan(score.error)) {
      sum += score.error;
      ++scored;
    }
    out.plants.push_back(score);
  }
  if (scored > 0) out.mean_error = sum / static_cast<double>(scored);
  return out;
}

GroundErrors ground_errors(const GroundPoints& truth, const Motion& estimate) {
  const Motion times{truth.time, {}};
  const Motion found = at_times_of(times, estimate);
  GroundErrors out;
  std::vector<double> distances;
  for (size_t i = 0; i < truth.time.size(); ++i) {
    const Eigen::Vector3d& pelvis = found.joints[i][Joint::kPelvis];
    if (distances.empty() && !known(pelvis)) continue;
    ++out.frames;
    if (known(pelvis)) distances.push_back((pelvis.head<2>() - truth.points[i]).norm());
  }
  if (out.frames > 0)
    out.filled_share = static_cast<double>(distances.size()) / static_cast<double>(out.frames);
  out.distance = error_statistics(std::move(distances));
  return out;
}

}  // namespace metrics
}  // namespace walktrack
