#include "metrics/statistics/coverage.h"

#include <algorithm>
#include <cmath>

#include "metrics/joint_error.h"

namespace walktrack {
inline namespace metrics {

namespace {

constexpr double kSameTime = 1e-4;  // s; times are written with a few decimals

void add(Coverage& sum, const Coverage& other) {
  sum.count += other.count;
  sum.share += other.share;
  sum.mean_width += other.mean_width;
}

// Turns sums into means.
void finish(Coverage& sum) {
  if (sum.count == 0) return;
  sum.share /= static_cast<double>(sum.count);
  sum.mean_width /= static_cast<double>(sum.count);
}

Coverage one_joint(const Eigen::Vector3d& truth, const Eigen::Vector3d& low,
                   const Eigen::Vector3d& high) {
  Coverage out;
  if (!known(truth) || !known(low) || !known(high)) return out;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    ++out.count;
    if (low[axis] <= truth[axis] && truth[axis] <= high[axis]) out.share += 1;
    out.mean_width += high[axis] - low[axis];
  }
  return out;
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
      add(out.by_joint[j],
          one_joint(truth.joints[i].at[j], uncertainty.p05[row].at[j], uncertainty.p95[row].at[j]));
  }
  for (const Joint joint : kScoredJoints) add(out.scored, out.by_joint[static_cast<size_t>(joint)]);
  finish(out.scored);
  for (Coverage& joint : out.by_joint) finish(joint);
  return out;
}

}  // namespace metrics
}  // namespace walktrack
