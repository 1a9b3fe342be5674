#include "body/motion.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "body/subject.h"
#include "core/errors.h"

namespace walktrack {
inline namespace body {

namespace {

using Eigen::Vector3d;

// Rows are written with at most 1e-5 s, so that times nearer than this are equal.
constexpr double kSameTime = 2e-5;

// Slope (per second) at row i from the rows around it; NaN if one of them is unknown or missing.
Vector3d central_slope(const Motion& motion, Joint joint, size_t i) {
  if (i == 0 || i + 1 >= motion.time.size())
    return Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  return (motion.joints[i + 1][joint] - motion.joints[i - 1][joint]) /
         (motion.time[i + 1] - motion.time[i - 1]);
}

// Interpolates between rows i and i + 1 at the share s in (0, 1).
Vector3d between(const Motion& motion, Joint joint, size_t i, double s) {
  const Vector3d& from = motion.joints[i][joint];
  const Vector3d& to = motion.joints[i + 1][joint];
  const double step = motion.time[i + 1] - motion.time[i];
  Vector3d start = step * central_slope(motion, joint, i);
  Vector3d end = step * central_slope(motion, joint, i + 1);
  if (!known(start) && !known(end)) return (1 - s) * from + s * to;
  // If one slope is unknown, the parabola through both points with the other slope.
  if (!known(start)) start = 2 * (to - from) - end;
  if (!known(end)) end = 2 * (to - from) - start;
  const double s2 = s * s, s3 = s2 * s;
  return (2 * s3 - 3 * s2 + 1) * from + (s3 - 2 * s2 + s) * start + (3 * s2 - 2 * s3) * to +
         (s3 - s2) * end;
}

}  // namespace

Ensemble ensemble_of(std::vector<Motion> members) {
  const size_t size = members.size();
  return {size, [members = std::move(members)](size_t index) { return members[index]; }};
}

JointPositions unknown_joints() {
  JointPositions out;
  out.at.fill(Vector3d::Constant(std::numeric_limits<double>::quiet_NaN()));
  return out;
}

double sample_period(const Motion& motion) {
  if (motion.time.size() < 2) throw InputError("a motion needs at least two rows to have a rate");
  std::vector<double> steps;
  for (size_t i = 1; i < motion.time.size(); ++i)
    steps.push_back(motion.time[i] - motion.time[i - 1]);
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle;
}

Motion resampled(const Motion& motion, std::span<const double> times, double longest_gap) {
  Motion out{{times.begin(), times.end()},
             std::vector<JointPositions>(times.size(), unknown_joints())};
  for (size_t k = 0; k < times.size(); ++k) {
    const auto after =
        std::lower_bound(motion.time.begin(), motion.time.end(), times[k] - kSameTime);
    if (after == motion.time.end()) continue;
    const size_t j = static_cast<size_t>(after - motion.time.begin());
    if (motion.time[j] <= times[k] + kSameTime) {
      out.joints[k] = motion.joints[j];
      continue;
    }
    if (j == 0 || motion.time[j] - motion.time[j - 1] > longest_gap) continue;
    const double s = (times[k] - motion.time[j - 1]) / (motion.time[j] - motion.time[j - 1]);
    for (int joint = 0; joint < kJointCount; ++joint)
      out.joints[k][static_cast<Joint>(joint)] =
          between(motion, static_cast<Joint>(joint), j - 1, s);
  }
  return out;
}

double stature_of(const Motion& motion) {
  const BodyLengths unit = body_lengths({.height = 1, .mass = 1, .lengths = {}});
  double sum = 0;
  size_t count = 0;
  for (const JointPositions& joints : motion.joints) {
    for (const Side side : {Side::kLeft, Side::kRight}) {
      const double length = (joints[hip(side)] - joints[knee(side)]).norm() +
                            (joints[knee(side)] - joints[ankle(side)]).norm();
      if (!std::isfinite(length)) continue;
      sum += length / (unit.thigh + unit.shank);
      ++count;
    }
  }
  return count > 0 && sum > 0 ? sum / static_cast<double>(count) : Subject{}.height;
}

}  // namespace body
}  // namespace walktrack
