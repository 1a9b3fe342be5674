#include "metrics/gait.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

#include "metrics/steps/toe_off.h"
#include "metrics/steps/walking_direction.h"

namespace walktrack {
inline namespace metrics {

namespace {

using Eigen::Vector2d;

// By hand, except for the retraction.
constexpr double kPathWindow = 0.5;      // s; about a step, so that sway and vertical motion are
                                         // averaged out
constexpr double kMatchWithin = 0.25;    // s; under half of the shortest usual stride
constexpr double kRetraction = 0.038;    // share of the stride after the turning point; see the
                                         // header
constexpr double kUsualStride = 1.1;     // s, for a motion with one turning point
constexpr double kLeastProgress = 0.15;  // m/s; slower than any walk, so that the direction is
                                         // undefined

// Consecutive rows [begin, end) in which pelvis and feet are known and the subject walks.
struct Run {
  size_t begin, end;
};

bool usable(const JointPositions& joints) {
  if (!known(joints[Joint::kPelvis])) return false;
  return known(foot_point(joints, Side::kLeft)) && known(foot_point(joints, Side::kRight));
}

Vector2d ground(const Eigen::Vector3d& point) { return point.head<2>(); }

// Whether the subject stands in row i: the pelvis hardly moves in the second around it, as far as
// that is known.
bool stands(const Motion& motion, size_t i) {
  constexpr double kAround = 0.5;  // s; by hand
  size_t a = i, b = i;
  while (a > 0 && usable(motion.joints[a - 1]) && motion.time[i] - motion.time[a - 1] <= kAround)
    --a;
  while (b + 1 < motion.time.size() && usable(motion.joints[b + 1]) &&
         motion.time[b + 1] - motion.time[i] <= kAround)
    ++b;
  const double time = motion.time[b] - motion.time[a];
  const Vector2d way =
      ground(motion.joints[b][Joint::kPelvis]) - ground(motion.joints[a][Joint::kPelvis]);
  return time >= kAround && way.norm() < kLeastProgress * time;
}

std::vector<Run> walking_runs(const Motion& motion) {
  std::vector<Run> runs;
  for (size_t i = 0; i < motion.time.size(); ++i) {
    if (!usable(motion.joints[i]) || stands(motion, i)) continue;
    if (runs.empty() || runs.back().end != i) runs.push_back({i, i});
    runs.back().end = i + 1;
  }
  std::erase_if(runs, [](const Run& run) { return run.end - run.begin < 3; });
  return runs;
}

// Rows of the run within half of kPathWindow around row i, symmetric also at the ends.
Run window_around(const Motion& motion, const Run& run, size_t i) {
  size_t reach = 0;
  while (i >= run.begin + reach + 1 && i + reach + 1 < run.end &&
         motion.time[i + reach + 1] - motion.time[i - reach - 1] <= kPathWindow)
    ++reach;
  return {i - reach, i + reach + 1};
}

// The position of the pelvis on the ground, averaged over kPathWindow.
std::vector<Vector2d> smoothed_path(const Motion& motion, const Run& run) {
  std::vector<Vector2d> path;
  for (size_t i = run.begin; i < run.end; ++i) {
    const Run window = window_around(motion, run, i);
    Vector2d sum = Vector2d::Zero();
    for (size_t k = window.begin; k < window.end; ++k)
      sum += ground(motion.joints[k][Joint::kPelvis]);
    path.push_back(sum / static_cast<double>(window.end - window.begin));
  }
  return path;
}

// Unit direction of walking at each row of the run, from kPathWindow / 2 before to the same time
// after it.
std::vector<Vector2d> directions(const Motion& motion, const Run& run,
                                 const std::vector<Vector2d>& path) {
  std::vector<Vector2d> out;
  for (size_t i = run.begin; i < run.end; ++i) {
    size_t a = i, b = i;
    while (a > run.begin && motion.time[i] - motion.time[a] < kPathWindow / 2) --a;
    while (b + 1 < run.end && motion.time[b] - motion.time[i] < kPathWindow / 2) ++b;
    const Vector2d way = path[b - run.begin] - path[a - run.begin];
    const bool walks = way.norm() > kLeastProgress * (motion.time[b] - motion.time[a]);
    out.push_back(walks ? Vector2d(way.normalized()) : Vector2d(Vector2d::Zero()));
  }
  return out;
}

// Time of the extremum of the parabola through samples i - 1, i, i + 1.
double refined_time(const Motion& motion, const Run& run, const std::vector<double>& signal,
                    size_t i) {
  const size_t row = run.begin + i;
  if (i == 0 || i + 1 >= signal.size()) return motion.time[row];
  const double curve = signal[i - 1] - 2 * signal[i] + signal[i + 1];
  if (curve == 0) return motion.time[row];
  const double shift = std::clamp(0.5 * (signal[i - 1] - signal[i + 1]) / curve, -0.5, 0.5);
  return motion.time[row] +
         shift * (motion.time[row + (shift > 0)] - motion.time[row - (shift <= 0)]);
}

// Maxima of the signal before and after which it changes by at least kLeastSwing.
std::vector<size_t> maxima(const std::vector<double>& signal) {
  std::vector<size_t> found;
  size_t low = 0, high = 0;
  bool rising = false;
  for (size_t i = 1; i < signal.size(); ++i) {
    if (rising) {
      if (signal[i] > signal[high]) high = i;
      if (signal[i] < signal[high] - kLeastSwing) {
        found.push_back(high);
        rising = false;
        low = i;
      }
    } else {
      if (signal[i] < signal[low]) low = i;
      if (signal[i] > signal[low] + kLeastSwing) {
        rising = true;
        high = i;
      }
    }
  }
  return found;
}

// Distances of the ankle in front of the pelvis and of the toe behind it, along the direction of
// walking.
struct FootSignals {
  std::vector<double> ankle_ahead, toe_behind;
};

FootSignals foot_signals(const Motion& motion, const Run& run,
                         const std::vector<Vector2d>& direction, Side side) {
  FootSignals out;
  for (size_t i = run.begin; i < run.end; ++i) {
    const JointPositions& joints = motion.joints[i];
    const Vector2d pelvis = ground(joints[Joint::kPelvis]);
    const Vector2d& way = direction[i - run.begin];
    out.ankle_ahead.push_back(way.dot(ground(joints[ankle(side)]) - pelvis));
    out.toe_behind.push_back(-way.dot(ground(joints[toe(side)]) - pelvis));
  }
  return out;
}

// Forward speed of a place on the ground, by row of the run: its central difference along the
// direction of walking, m/s.
template <typename Place>
std::vector<double> forward_speeds(const Motion& motion, const Run& run,
                                   const std::vector<Vector2d>& direction, const Place& place) {
  std::vector<double> out;
  for (size_t i = run.begin; i < run.end; ++i) {
    const size_t before = std::max(i, run.begin + 1) - 1, after = std::min(i + 1, run.end - 1);
    out.push_back(direction[i - run.begin].dot(place(after) - place(before)) /
                  (motion.time[after] - motion.time[before]));
  }
  return out;
}

std::vector<GaitEvent> toe_offs(const Motion& motion, const Run& run,
                                const std::vector<Vector2d>& direction,
                                const std::vector<Vector2d>& path,
                                const std::vector<double>& toe_behind, Side side) {
  const std::span time = std::span(motion.time).subspan(run.begin, run.end - run.begin);
  const auto toe_speed = forward_speeds(
      motion, run, direction, [&](size_t i) { return ground(motion.joints[i][toe(side)]); });
  const auto pelvis_speed =
      forward_speeds(motion, run, direction, [&](size_t i) { return path[i - run.begin]; });
  std::vector<GaitEvent> out;
  for (const size_t i : maxima(toe_behind)) {
    const auto leaves = toe_off_time(time, toe_speed, i, pelvis_speed[i]);
    out.push_back(
        {leaves.value_or(refined_time(motion, run, toe_behind, i)), side, GaitEventKind::kToeOff});
  }
  return out;
}

// Twice the mean time between successive turning points, which are those of one foot and the other
// in turn. One that is missed makes it longer.
double stride_time(const std::vector<GaitEvent>& turns) {
  if (turns.size() < 2) return kUsualStride;
  return 2 * (turns.back().time - turns.front().time) / static_cast<double>(turns.size() - 1);
}

std::vector<GaitEvent> events_of(const Motion& motion, const Run& run,
                                 const std::vector<Vector2d>& direction,
                                 const std::vector<Vector2d>& path) {
  const auto sort = [](std::vector<GaitEvent>& events) {
    std::stable_sort(events.begin(), events.end(),
                     [](const GaitEvent& a, const GaitEvent& b) { return a.time < b.time; });
  };
  std::vector<GaitEvent> strikes, events;
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const FootSignals foot = foot_signals(motion, run, direction, side);
    for (const size_t i : maxima(foot.ankle_ahead))
      strikes.push_back(
          {refined_time(motion, run, foot.ankle_ahead, i), side, GaitEventKind::kFootStrike});
    for (const GaitEvent& each : toe_offs(motion, run, direction, path, foot.toe_behind, side))
      events.push_back(each);
  }
  sort(strikes);
  const double retraction = kRetraction * stride_time(strikes);
  for (GaitEvent& strike : strikes) {
    strike.time += retraction;
    if (strike.time <= motion.time[run.end - 1]) events.push_back(strike);
  }
  sort(events);
  return events;
}

// Mean position of the foot in the flat part of the stance, or in all of it if that part has no
// row.
Vector2d stance_place(const Motion& motion, const Run& run, const Stance& stance) {
  const double length = stance.off - stance.on;
  for (const auto& [from, to] : {std::pair{kFlatFrom, kFlatTo}, std::pair{0.0, 1.0}}) {
    Vector2d sum = Vector2d::Zero();
    size_t count = 0;
    for (size_t i = run.begin; i < run.end; ++i) {
      const double t = motion.time[i];
      if (t < stance.on + from * length || t > stance.on + to * length) continue;
      sum += ground(foot_point(motion.joints[i], stance.side));
      ++count;
    }
    if (count > 0) return sum / static_cast<double>(count);
  }
  return ground(foot_point(motion.joints[run.begin], stance.side));
}

void add_stances(const Motion& motion, const Run& run, const std::vector<GaitEvent>& events,
                 Side side, std::vector<Stance>& stances) {
  const double start = motion.time[run.begin], end = motion.time[run.end - 1];
  std::optional<double> on;
  bool from_event = false, first = true;
  const auto close = [&](double off, bool to_event) {
    Stance stance{side, *on, off, from_event, to_event, Vector2d::Zero()};
    stance.place = stance_place(motion, run, stance);
    stances.push_back(stance);
    on.reset();
  };
  for (const GaitEvent& event : events) {
    if (event.side != side) continue;
    if (event.kind == GaitEventKind::kFootStrike) {
      on = event.time;
      from_event = true;
    } else {
      if (first) on = start, from_event = false;
      if (on) close(event.time, true);
    }
    first = false;
  }
  if (on) close(end, false);
}

// Twice the mean time between the strikes of successive feet.
double stride_time_of(const std::vector<Stance>& stances) {
  double sum = 0, count = 0;
  for (size_t i = 1; i < stances.size(); ++i) {
    if (!is_step(stances[i - 1], stances[i])) continue;
    sum += stances[i].on - stances[i - 1].on;
    ++count;
  }
  return count > 0 ? 2 * sum / count : kUsualStride;
}

void add_steps(const Motion& motion, Gait& gait) {
  double length = 0, width = 0, time = 0;
  for (size_t i = 1; i < gait.stances.size(); ++i) {
    const Stance& a = gait.stances[i - 1];
    const Stance& b = gait.stances[i];
    if (!is_step(a, b)) continue;
    const Vector2d way = walking_direction(motion, 0.5 * (a.on + b.on), gait.stride_time);
    if (!way.allFinite()) continue;
    const Vector2d step = b.place - a.place;
    gait.steps.push_back(
        {i - 1, i, way.dot(step), std::abs(way.x() * step.y() - way.y() * step.x()), b.on - a.on});
    length += gait.steps.back().length;
    width += gait.steps.back().width;
    time += gait.steps.back().time;
  }
  if (gait.steps.empty()) return;
  const auto steps = static_cast<double>(gait.steps.size());
  gait.mean_step_length = length / steps;
  gait.mean_step_width = width / steps;
  gait.mean_step_time = time / steps;
}

double mean_stance_share(const std::vector<Stance>& stances) {
  double sum = 0;
  size_t count = 0;
  for (size_t i = 0; i < stances.size(); ++i) {
    const Stance* next = stride_end(stances, i);
    if (!next || !stances[i].ends_in_motion) continue;
    sum += (stances[i].off - stances[i].on) / (next->on - stances[i].on);
    ++count;
  }
  return count > 0 ? sum / static_cast<double>(count) : 0;
}

}  // namespace

bool is_step(const Stance& from, const Stance& to) {
  constexpr double kLongestFlight = 0.5;  // s; a foot that comes later belongs to another walk
  return from.side != to.side && from.starts_in_motion && to.starts_in_motion &&
         to.on <= from.off + kLongestFlight;
}

const Stance* next_of_side(const std::vector<Stance>& stances, size_t from) {
  constexpr double kLongestSwing = 1;  // s; by hand: those of .2 m/s last half of that
  const auto next =
      std::find_if(stances.begin() + static_cast<std::ptrdiff_t>(from) + 1, stances.end(),
                   [&](const Stance& s) { return s.side == stances[from].side; });
  const bool swung = next != stances.end() && next->starts_in_motion &&
                     next->on <= stances[from].off + kLongestSwing;
  return swung ? &*next : nullptr;
}

const Stance* stride_end(const std::vector<Stance>& stances, size_t from) {
  return stances[from].starts_in_motion ? next_of_side(stances, from) : nullptr;
}

Gait gait_from_motion(const Motion& motion) {
  Gait gait;
  double duration = 0;
  for (const Run& run : walking_runs(motion)) {
    ++gait.walks;
    const std::vector<Vector2d> path = smoothed_path(motion, run);
    for (size_t i = 1; i < path.size(); ++i) gait.way += (path[i] - path[i - 1]).norm();
    duration += motion.time[run.end - 1] - motion.time[run.begin];
    const std::vector<Vector2d> direction = directions(motion, run, path);
    const std::vector<GaitEvent> events = events_of(motion, run, direction, path);
    for (const Side side : {Side::kLeft, Side::kRight})
      add_stances(motion, run, events, side, gait.stances);
    gait.events.insert(gait.events.end(), events.begin(), events.end());
  }
  std::stable_sort(gait.stances.begin(), gait.stances.end(), [](const Stance& a, const Stance& b) {
    return a.on < b.on || (a.on == b.on && a.off < b.off);
  });
  if (duration > 0) gait.speed = gait.way / duration;
  gait.stride_time = stride_time_of(gait.stances);
  add_steps(motion, gait);
  gait.stance_share = mean_stance_share(gait.stances);
  return gait;
}

EventErrors event_errors(const std::vector<GaitEvent>& truth,
                         const std::vector<GaitEvent>& estimate) {
  EventErrors out;
  std::vector<bool> used(estimate.size(), false);
  double late = 0, absolute = 0;
  for (const GaitEvent& event : truth) {
    size_t best = estimate.size();
    for (size_t i = 0; i < estimate.size(); ++i) {
      if (used[i] || estimate[i].side != event.side || estimate[i].kind != event.kind) continue;
      const double distance = std::abs(estimate[i].time - event.time);
      if (distance > kMatchWithin) continue;
      if (best == estimate.size() || distance < std::abs(estimate[best].time - event.time))
        best = i;
    }
    if (best == estimate.size()) {
      ++out.missed;
      continue;
    }
    used[best] = true;
    ++out.matched;
    late += estimate[best].time - event.time;
    absolute += std::abs(estimate[best].time - event.time);
  }
  out.extra = estimate.size() - out.matched;
  if (out.matched > 0) {
    out.mean_late = late / static_cast<double>(out.matched);
    out.mean_absolute = absolute / static_cast<double>(out.matched);
  }
  return out;
}

}  // namespace metrics
}  // namespace walktrack
