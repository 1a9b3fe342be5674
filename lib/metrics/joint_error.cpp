#include "metrics/joint_error.h"

#include <Eigen/Geometry>

#include "core/errors.h"

namespace walktrack {

namespace {

using Eigen::Vector3d;
using ScoredPoints = Eigen::Matrix<double, 3, kScoredJoints.size()>;

constexpr double kAnklesApart = 0.25;  // m; closer together, sides are not told apart
constexpr double kLongestGap = 1.5;    // sample periods; a missing row is a gap

ScoredPoints scored_points(const JointPositions& joints) {
  ScoredPoints out;
  for (size_t i = 0; i < kScoredJoints.size(); ++i)
    out.col(static_cast<Eigen::Index>(i)) = joints[kScoredJoints[i]];
  return out;
}

double mean_distance(const ScoredPoints& a, const ScoredPoints& b) {
  return (a - b).colwise().norm().mean();
}

double distance_after_similarity(const ScoredPoints& truth, const ScoredPoints& estimate) {
  const Eigen::Matrix4d truth_from_estimate = Eigen::umeyama(estimate, truth, true);
  const ScoredPoints moved = (truth_from_estimate.topLeftCorner<3, 3>() * estimate).colwise() +
                             Vector3d(truth_from_estimate.topRightCorner<3, 1>());
  return mean_distance(truth, moved);
}

bool swapped(const JointPositions& truth, const JointPositions& estimate) {
  if ((truth[Joint::kLeftAnkle] - truth[Joint::kRightAnkle]).norm() <= kAnklesApart) return false;
  const auto nearer_other = [&](Joint own, Joint others) {
    return (estimate[own] - truth[others]).norm() < (estimate[own] - truth[own]).norm();
  };
  for (const Side side : {Side::kLeft, Side::kRight}) {
    if (nearer_other(knee(side), knee(other(side))) &&
        nearer_other(ankle(side), ankle(other(side))))
      return true;
  }
  return false;
}

void add_each_joint(const JointPositions& truth, const JointPositions& estimate,
                    std::array<std::vector<double>, kJointCount>& distances) {
  for (size_t j = 0; j < kJointCount; ++j) {
    const Vector3d error = estimate.at[j] - truth.at[j];
    if (known(error)) distances[j].push_back(error.norm());
  }
}

}  // namespace

bool scored_joints_known(const JointPositions& joints) { return scored_points(joints).allFinite(); }

Motion at_times_of(const Motion& truth, const Motion& estimate) {
  const double gap = estimate.time.size() < 2 ? 0.0 : kLongestGap * sample_period(estimate);
  return resampled(estimate, truth.time, gap);
}

JointErrors joint_errors(const Motion& truth, const Motion& estimate) {
  const Motion found = at_times_of(truth, estimate);
  JointErrors out;
  size_t usable = 0, filled = 0, swaps = 0;
  std::vector<double> absolute, relative, aligned;
  std::array<std::vector<double>, kJointCount> distances;
  for (size_t i = 0; i < truth.time.size(); ++i) {
    if (!scored_joints_known(truth.joints[i])) continue;
    ++usable;
    const bool is_filled = scored_joints_known(found.joints[i]);
    if (!is_filled && filled == 0) continue;
    if (filled == 0) out.start = truth.time[i];
    ++out.frames;
    if (!is_filled) continue;
    ++filled;
    const ScoredPoints a = scored_points(truth.joints[i]), b = scored_points(found.joints[i]);
    absolute.push_back(mean_distance(a, b));
    relative.push_back(mean_distance(a.colwise() - a.col(0), b.colwise() - b.col(0)));
    aligned.push_back(distance_after_similarity(a, b));
    add_each_joint(truth.joints[i], found.joints[i], distances);
    if (swapped(truth.joints[i], found.joints[i])) ++swaps;
  }
  if (usable == 0) throw InputError("no row of the truth knows pelvis, hips, knees and ankles");
  if (filled > 0) {
    out.filled_share = static_cast<double>(filled) / static_cast<double>(out.frames);
    out.swapped_share = static_cast<double>(swaps) / static_cast<double>(filled);
  }
  out.absolute = error_statistics(std::move(absolute));
  out.pelvis_relative = error_statistics(std::move(relative));
  out.procrustes = error_statistics(std::move(aligned));
  for (size_t j = 0; j < kJointCount; ++j)
    out.by_joint[j] = error_statistics(std::move(distances[j]));
  return out;
}

}  // namespace walktrack
