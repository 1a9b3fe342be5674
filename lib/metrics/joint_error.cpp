#include "metrics/joint_error.h"

#include <algorithm>
#include <optional>

#include <Eigen/Geometry>

#include "core/errors.h"

namespace walktrack {
inline namespace metrics {

namespace {

using Eigen::Vector3d;
using ScoredPoints = Eigen::Matrix<double, 3, kScoredJoints.size()>;

// By hand.
constexpr double kAnklesApart = 0.25;  // m; if they are closer together, sides are not
                                       // distinguished
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

// The similarity transform that fits the estimate to the truth best.
Eigen::Affine3d similarity(const ScoredPoints& truth, const ScoredPoints& estimate) {
  return Eigen::Affine3d(Eigen::umeyama(estimate, truth, true));
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

// Distances in all frames so far.
struct Distances {
  std::vector<double> absolute, pelvis_relative, procrustes;
};

void add_each_joint(const JointPositions& truth, const JointPositions& estimate,
                    const Eigen::Affine3d& aligned, std::array<Distances, kJointCount>& distances) {
  const Vector3d offset = estimate[Joint::kPelvis] - truth[Joint::kPelvis];
  for (size_t j = 0; j < kJointCount; ++j) {
    const Vector3d error = estimate.at[j] - truth.at[j];
    if (!known(error)) continue;
    distances[j].absolute.push_back(error.norm());
    distances[j].pelvis_relative.push_back((error - offset).norm());
    distances[j].procrustes.push_back((aligned * estimate.at[j] - truth.at[j]).norm());
  }
}

JointErrors::OfJoint statistics_of(Distances distances) {
  return {error_statistics(std::move(distances.absolute)),
          error_statistics(std::move(distances.pelvis_relative)),
          error_statistics(std::move(distances.procrustes))};
}

// The horizontal direction in which the pelvis moves in the second around a row; nullopt if it
// hardly moves.
std::optional<Vector3d> way_at(const Motion& motion, size_t row) {
  constexpr double kHalfWindow = 0.5;  // s; together a stride, so that sway is averaged out
  constexpr double kLeastWay = 0.1;    // m; by hand
  std::optional<Vector3d> first, last;
  const double now = motion.time[row];
  const auto begin = std::lower_bound(motion.time.begin(), motion.time.end(), now - kHalfWindow);
  for (auto t = begin; t != motion.time.end() && *t <= now + kHalfWindow; ++t) {
    const Vector3d& pelvis =
        motion.joints[static_cast<size_t>(t - motion.time.begin())][Joint::kPelvis];
    if (!known(pelvis)) continue;
    if (!first) first = pelvis;
    last = pelvis;
  }
  if (!first) return std::nullopt;
  Vector3d way = *last - *first;
  way.z() = 0;
  if (way.norm() < kLeastWay) return std::nullopt;
  return way.normalized();
}

double leg_length(const JointPositions& joints) {
  double sum = 0;
  for (const Side side : {Side::kLeft, Side::kRight})
    sum += (joints[hip(side)] - joints[knee(side)]).norm() +
           (joints[knee(side)] - joints[ankle(side)]).norm();
  return sum;
}

// Signed errors, in which random errors cancel.
class SignedErrors {
 public:
  void add(const Motion& truth, size_t row, const JointPositions& estimate) {
    const JointPositions& joints = truth.joints[row];
    ratios_ += leg_length(estimate) / leg_length(joints);
    ++frames_;
    const std::optional<Vector3d> way = way_at(truth, row);
    if (!way) return;
    const Vector3d offset = estimate[Joint::kPelvis] - joints[Joint::kPelvis];
    const Vector3d left = Vector3d::UnitZ().cross(*way);
    offsets_ += Vector3d(offset.dot(*way), offset.dot(left), offset.z());
    ++walking_frames_;
  }
  void write_to(JointErrors& out) const {
    if (frames_ > 0) out.leg_length_ratio = ratios_ / static_cast<double>(frames_);
    if (walking_frames_ > 0) out.mean_offset = offsets_ / static_cast<double>(walking_frames_);
  }

 private:
  size_t frames_ = 0, walking_frames_ = 0;
  double ratios_ = 0;
  Vector3d offsets_ = Vector3d::Zero();
};

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
  Distances frames;
  std::array<Distances, kJointCount> distances;
  SignedErrors errors;
  for (size_t i = 0; i < truth.time.size(); ++i) {
    if (!scored_joints_known(truth.joints[i])) continue;
    ++usable;
    const bool is_filled = scored_joints_known(found.joints[i]);
    if (!is_filled && filled == 0) continue;
    if (filled == 0) out.start = truth.time[i];
    ++out.frames;
    out.time.push_back(truth.time[i]);
    out.by_frame.push_back(std::numeric_limits<double>::quiet_NaN());
    if (!is_filled) continue;
    ++filled;
    const ScoredPoints a = scored_points(truth.joints[i]), b = scored_points(found.joints[i]);
    const Eigen::Affine3d aligned = similarity(a, b);
    out.by_frame.back() = mean_distance(a, b);
    frames.absolute.push_back(out.by_frame.back());
    frames.pelvis_relative.push_back(mean_distance(a.colwise() - a.col(0), b.colwise() - b.col(0)));
    frames.procrustes.push_back(mean_distance(a, aligned * b));
    add_each_joint(truth.joints[i], found.joints[i], aligned, distances);
    errors.add(truth, i, found.joints[i]);
    if (swapped(truth.joints[i], found.joints[i])) ++swaps;
  }
  if (usable == 0) throw InputError("no row of the truth knows pelvis, hips, knees and ankles");
  if (filled > 0) {
    out.filled_share = static_cast<double>(filled) / static_cast<double>(out.frames);
    out.swapped_share = static_cast<double>(swaps) / static_cast<double>(filled);
  }
  errors.write_to(out);
  const JointErrors::OfJoint all = statistics_of(std::move(frames));
  out.absolute = all.absolute;
  out.pelvis_relative = all.pelvis_relative;
  out.procrustes = all.procrustes;
  for (size_t j = 0; j < kJointCount; ++j) out.by_joint[j] = statistics_of(std::move(distances[j]));
  return out;
}

}  // namespace metrics
}  // namespace walktrack
