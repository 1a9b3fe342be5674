#include "metrics/steps/walking_direction.h"

#include <algorithm>
#include <limits>

namespace walktrack {
inline namespace metrics {

namespace {

using Eigen::Vector2d;

Vector2d unknown() { return Vector2d::Constant(std::numeric_limits<double>::quiet_NaN()); }

bool has_pelvis(const Motion& motion, size_t row) {
  return known(motion.joints[row][Joint::kPelvis]);
}

}  // namespace

Vector2d on_ground(const Motion& motion, Joint joint, double time) {
  const auto after = std::lower_bound(motion.time.begin(), motion.time.end(), time);
  if (after == motion.time.end() || (after == motion.time.begin() && *after > time))
    return unknown();
  const auto b = static_cast<size_t>(after - motion.time.begin()), a = b > 0 ? b - 1 : b;
  Vector2d to = motion.joints[b][joint].head<2>();
  if (motion.time[b] == time) return to;
  const double share = (time - motion.time[a]) / (motion.time[b] - motion.time[a]);
  return (1 - share) * motion.joints[a][joint].head<2>() + share * to;
}

Vector2d walking_direction(const Motion& motion, double time, double stride_time) {
  const auto row = std::lower_bound(motion.time.begin(), motion.time.end(), time);
  if (row == motion.time.end()) return unknown();
  size_t first = static_cast<size_t>(row - motion.time.begin()), last = first;
  if (!has_pelvis(motion, first)) return unknown();
  while (first > 0 && has_pelvis(motion, first - 1) && time - motion.time[first] < stride_time)
    --first;
  while (last + 1 < motion.time.size() && has_pelvis(motion, last + 1) &&
         motion.time[last] - time < stride_time)
    ++last;
  const double begin = motion.time[first], end = motion.time[last];
  // Sums are rounded: neither end may come to lie outside.
  const double from = std::max(begin, std::min(time - stride_time / 2, end - stride_time));
  const double to = std::min(end, from + stride_time);
  const Vector2d way =
      on_ground(motion, Joint::kPelvis, to) - on_ground(motion, Joint::kPelvis, from);
  return way.norm() > 0 ? Vector2d(way.normalized()) : unknown();
}

}  // namespace metrics
}  // namespace walktrack
