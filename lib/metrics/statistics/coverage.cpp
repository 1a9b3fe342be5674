#include "metrics/statistics/coverage.h"

#include <algorithm>
#include <cmath>

#include "metrics/joint_error.h"

namespace walktrack {
inline namespace metrics {

namespace {

constexpr double kSameTime = 1e-4;  // s; times are written with a few decimals

// Half of an interval in standard deviations, by level (Abramowitz & Stegun 1964, table 26.1).
constexpr std::array<double, kIntervalLevels.size()> kHalfWidths{
    0.12566, 0.25335, 0.38532, 0.52440, 0.67449, 0.84162, 1.03643, 1.28155, 1.64485};

// Into sums; scale() turns them into means.
void add_coordinate(double truth, double low, double high, Coverage& sum) {
  ++sum.count;
  if (low <= truth && truth <= high) sum.share += 1;
  sum.mean_width += high - low;
  const double off = std::abs(truth - 0.5 * (low + high)), half = 0.5 * (high - low);
  for (size_t k = 0; k < kHalfWidths.size(); ++k)
    if (off <= half * kHalfWidths[k] / kHalfWidths.back()) sum.share_of_level[k] += 1;
}

void add_joint(const Eigen::Vector3d& truth, const Eigen::Vector3d& low,
               const Eigen::Vector3d& high, std::array<Coverage, 2>& sums) {
  if (!known(truth) || !known(low) || !known(high)) return;
  for (Eigen::Index axis = 0; axis < 3; ++axis)
    add_coordinate(truth[axis], low[axis], high[axis], sums[axis == 2 ? 1 : 0]);
}

void scale(double by, Coverage& coverage) {
  coverage.share *= by;
  coverage.mean_width *= by;
  for (double& share : coverage.share_of_level) share *= by;
}

}  // namespace

CoverageReport coverage(const Motion& truth, const JointUncertainty& uncertainty) {
  CoverageReport out;
  size_t row = 0;
  for (size_t i = 0; i < truth.time.size(); ++i) {
    while (row < uncertainty.time.size() && uncertainty.time[row] < truth.time[i] - kSameTime)
      ++row;
    if (row == uncertainty.time.size()) break;
    if (uncertainty.time[row] > truth.time[i] + kSameTime) continue;
    for (size_t j = 0; j < kJointCount; ++j)
      add_joint(truth.joints[i].at[j], uncertainty.p05[row].at[j], uncertainty.p95[row].at[j],
                out.by_joint[j]);
  }
  std::vector<Coverage> scored;
  for (std::array<Coverage, 2>& joint : out.by_joint)
    for (Coverage& each : joint)
      if (each.count > 0) scale(1 / static_cast<double>(each.count), each);
  for (const Joint joint : kScoredJoints)
    for (const Direction direction : {Direction::kLevel, Direction::kUp})
      scored.push_back(out.of(joint, direction));
  out.scored = joined(scored);
  return out;
}

Coverage joined(std::span<const Coverage> parts) {
  Coverage out;
  for (Coverage part : parts) {
    scale(static_cast<double>(part.count), part);
    out.count += part.count;
    out.share += part.share;
    out.mean_width += part.mean_width;
    for (size_t k = 0; k < kIntervalLevels.size(); ++k)
      out.share_of_level[k] += part.share_of_level[k];
  }
  if (out.count > 0) scale(1 / static_cast<double>(out.count), out);
  return out;
}

double calibration_error(const Coverage& coverage) {
  double sum = 0;
  for (size_t k = 0; k < kIntervalLevels.size(); ++k)
    sum += std::abs(coverage.share_of_level[k] - kIntervalLevels[k]);
  return sum / static_cast<double>(kIntervalLevels.size());
}

}  // namespace metrics
}  // namespace walktrack
