#include "metrics/steps/foot_placement.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/conventions.h"
#include "metrics/steps/walking_direction.h"

namespace walktrack {
inline namespace metrics {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
constexpr double kFast = 0.8;  // of the swing's highest speed

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

double angle_deg(const Vector2d& from, const Vector2d& to) {
  return deg_from_rad(std::atan2(cross(from, to), from.dot(to)));
}

// The next stance of the other foot, if it is the next step.
std::optional<size_t> next_step(const Gait& gait, size_t stance) {
  const bool steps =
      stance + 1 < gait.stances.size() && is_step(gait.stances[stance], gait.stances[stance + 1]);
  return steps ? std::optional(stance + 1) : std::nullopt;
}

struct Rows {
  size_t first, end;
};

// The rows from one time to another, both included.
Rows rows_between(const Motion& motion, double from, double to) {
  const auto index = [&](auto at) { return static_cast<size_t>(at - motion.time.begin()); };
  const size_t first = index(std::ranges::lower_bound(motion.time, from));
  return {first, std::max(first, index(std::ranges::upper_bound(motion.time, to)))};
}

// The mean over the rows in which the sole of a stance is flat; nothing if there are none.
template <typename F>
std::optional<Vector3d> mean_while_flat(const Motion& motion, const Stance& stance,
                                        const F& value) {
  const double length = stance.off - stance.on;
  const Rows rows =
      rows_between(motion, stance.on + kFlatFrom * length, stance.on + kFlatTo * length);
  Vector3d sum = Vector3d::Zero();
  for (size_t i = rows.first; i < rows.end; ++i) sum += value(motion.joints[i]);
  if (rows.first == rows.end) return std::nullopt;
  return Vector3d(sum / double(rows.end - rows.first));
}

}  // namespace

double toe_clearance(const Motion& motion, const Gait& gait, size_t stance) {
  const Stance& before = gait.stances[stance];
  const Joint joint = toe(before.side);
  const Stance* after = next_of_side(gait.stances, stance);
  if (!after || !before.ends_in_motion) return kUnknown;
  const auto flat =
      mean_while_flat(motion, before, [&](const JointPositions& joints) { return joints[joint]; });
  if (!flat) return kUnknown;
  const auto speed = [&](size_t i) {
    const size_t a = std::max<size_t>(i, 1) - 1, b = std::min(i + 1, motion.time.size() - 1);
    return (motion.joints[b][joint] - motion.joints[a][joint]).head<2>().norm() /
           (motion.time[b] - motion.time[a]);
  };
  double highest = 0, lowest = std::numeric_limits<double>::infinity();
  const Rows swing = rows_between(motion, before.off, after->on);
  for (size_t i = swing.first; i < swing.end; ++i) {
    if (!known(motion.joints[i][joint])) return kUnknown;
    highest = std::max(highest, speed(i));
  }
  for (size_t i = swing.first; i < swing.end; ++i)
    if (speed(i) >= kFast * highest) lowest = std::min(lowest, motion.joints[i][joint].z());
  return std::isfinite(lowest) ? lowest - flat->z() : kUnknown;
}

double foot_progression_deg(const Motion& motion, const Gait& gait, size_t stance) {
  const Stance& now = gait.stances[stance];
  if (!now.starts_in_motion || !now.ends_in_motion) return kUnknown;
  const auto foot = mean_while_flat(motion, now, [&](const JointPositions& joints) {
    return Vector3d(joints[toe(now.side)] - joints[ankle(now.side)]);
  });
  if (!foot) return kUnknown;
  const double middle = now.on + 0.5 * (kFlatFrom + kFlatTo) * (now.off - now.on);
  const Vector2d way = walking_direction(motion, middle, gait.stride_time);
  return outward(now.side) * angle_deg(way, foot->head<2>());
}

double width_at_strike(const Motion& motion, const Gait& gait, size_t stance) {
  const Stance& now = gait.stances[stance];
  if (!now.starts_in_motion) return kUnknown;
  const Vector2d apart = on_ground(motion, ankle(now.side), now.on) -
                         on_ground(motion, ankle(other(now.side)), now.on);
  return outward(now.side) * cross(walking_direction(motion, now.on, gait.stride_time), apart);
}

double walking_base(const Gait& gait, size_t stance) {
  if (stance == 0 || next_step(gait, stance - 1) != stance) return kUnknown;
  const auto next = next_step(gait, stance);
  if (!next) return kUnknown;
  const Stance &now = gait.stances[stance], &before = gait.stances[stance - 1];
  const Vector2d line = (gait.stances[*next].place - before.place).normalized();
  return outward(now.side) * cross(line, now.place - before.place);
}

double turn_deg(const Motion& motion, const Gait& gait, size_t stance) {
  const auto next = next_step(gait, stance);
  if (!next || stance == 0 || next_step(gait, stance - 1) != stance) return kUnknown;
  const double now = gait.stances[stance].on;
  const double before = 0.5 * (gait.stances[stance - 1].on + now),
               after = 0.5 * (now + gait.stances[*next].on);
  return angle_deg(walking_direction(motion, before, gait.stride_time),
                   walking_direction(motion, after, gait.stride_time));
}

}  // namespace metrics
}  // namespace walktrack
