#include "metrics/plausibility.h"

#include <algorithm>
#include <cmath>

#include "metrics/joint_error.h"
#include "metrics/steps/walking_direction.h"

namespace walktrack {
inline namespace metrics {

namespace {

// By hand.
constexpr double kPenetrates = 0.005;  // m; less is within the noise of any measurement
constexpr size_t kFewestTimes = 3;     // of steps, for a median
constexpr double kLongSteps = 1.1;     // m, of tall people
constexpr double kRegular = 0.01;      // relative; rows further from equal steps are a gap

// The known places of the foot over the ground in the flat part.
std::vector<Eigen::Vector2d> flat_places(const Motion& motion, const Stance& stance) {
  const double length = stance.off - stance.on;
  std::vector<Eigen::Vector2d> places;
  for (size_t i = 0; i < motion.time.size(); ++i) {
    const double t = motion.time[i];
    if (t < stance.on + kFlatFrom * length || t > stance.on + kFlatTo * length) continue;
    const Eigen::Vector3d foot = foot_point(motion.joints[i], stance.side);
    if (known(foot)) places.push_back(foot.head<2>());
  }
  return places;
}

// Largest of the distances between two of the places.
template <typename Distance>
double largest(const std::vector<Eigen::Vector2d>& places, const Distance& distance) {
  double largest = 0;
  for (size_t i = 0; i < places.size(); ++i) {
    for (size_t k = 0; k < i; ++k) largest = std::max(largest, distance(places[i] - places[k]));
  }
  return largest;
}

void add_slides(const Motion& motion, const Gait& gait, Plausibility& out) {
  for (const Stance& stance : gait.stances) {
    if (!stance.starts_in_motion || !stance.ends_in_motion) continue;
    const std::vector<Eigen::Vector2d> places = flat_places(motion, stance);
    if (places.size() < 2) continue;
    const Eigen::Vector2d way =
        walking_direction(motion, 0.5 * (stance.on + stance.off), gait.stride_time);
    const double travel = largest(places, [](const auto& by) { return by.norm(); });
    ++out.stances;
    out.mean_foot_slide += travel;
    out.worst_foot_slide = std::max(out.worst_foot_slide, travel);
    const auto along = [&](const Eigen::Vector2d& by) { return std::abs(by.dot(way)); };
    // Where no direction is known, the whole displacement counts.
    out.mean_slide_along += way.allFinite() ? largest(places, along) : travel;
  }
  if (out.stances == 0) return;
  out.mean_foot_slide /= static_cast<double>(out.stances);
  out.mean_slide_along /= static_cast<double>(out.stances);
}

void add_penetration(const Motion& motion, Plausibility& out) {
  size_t rows = 0, deep = 0;
  for (const JointPositions& joints : motion.joints) {
    double lowest = 0;
    bool seen = false;
    for (const Side side : {Side::kLeft, Side::kRight}) {
      for (const Joint joint : {ankle(side), toe(side)}) {
        if (!known(joints[joint])) continue;
        seen = true;
        lowest = std::min(lowest, joints[joint].z());
      }
    }
    if (!seen) continue;
    ++rows;
    if (lowest < -kPenetrates) ++deep;
    out.penetration = std::max(out.penetration, -lowest);
  }
  if (rows > 0) out.penetrating_share = static_cast<double>(deep) / static_cast<double>(rows);
}

double mean_jerk(const Motion& motion) {
  double sum = 0;
  size_t count = 0;
  for (size_t i = 3; i < motion.time.size(); ++i) {
    const double step = (motion.time[i] - motion.time[i - 3]) / 3;
    const auto irregular = [&](size_t k) {
      return std::abs(motion.time[k] - motion.time[k - 1] - step) > kRegular * step + 1e-4;
    };
    if (irregular(i) || irregular(i - 1)) continue;
    for (const Joint joint : kScoredJoints) {
      const Eigen::Vector3d third = motion.joints[i][joint] - 3 * motion.joints[i - 1][joint] +
                                    3 * motion.joints[i - 2][joint] - motion.joints[i - 3][joint];
      if (!known(third)) continue;
      sum += third.norm() / (step * step * step);
      ++count;
    }
  }
  return count > 0 ? sum / static_cast<double>(count) : 0;
}

void add_steps(const Motion& motion, const Gait& gait, Plausibility& out) {
  if (gait.steps.empty()) return;
  double steps = 0, way = 0;
  out.longest_step = out.shortest_step = gait.steps[0].length;
  for (const Step& step : gait.steps) {
    out.longest_step = std::max(out.longest_step, step.length);
    out.shortest_step = std::min(out.shortest_step, step.length);
    steps += step.length;
    const double from = gait.stances[step.from].on, to = gait.stances[step.to].on;
    const Eigen::Vector2d pelvis =
        on_ground(motion, Joint::kPelvis, to) - on_ground(motion, Joint::kPelvis, from);
    way += pelvis.dot(walking_direction(motion, 0.5 * (from + to), gait.stride_time));
  }
  out.steps_off_way = way > 0 ? std::abs(steps / way - 1) : 1;
}

// A person who walks moves forward only by taking steps. Where none is complete they may be as long
// as anybody's.
double missing_steps(const Gait& gait) {
  const double length = gait.mean_step_length > 0 ? gait.mean_step_length : kLongSteps;
  return std::max(0.0, gait.way / length - double(gait.steps.size() + 2 * gait.walks));
}

// If legs are swapped while the subject walks on, a step takes no time, or one foot strikes twice
// in succession.
double quickest_step(const Gait& gait) {
  std::vector<double> times;
  const GaitEvent* last = nullptr;
  for (const GaitEvent& event : gait.events) {
    if (event.kind != GaitEventKind::kFootStrike) continue;
    if (last) times.push_back((event.time - last->time) / (event.side == last->side ? 2 : 1));
    last = &event;
  }
  if (times.size() < kFewestTimes) return 1;
  std::sort(times.begin(), times.end());
  const double median = times[times.size() / 2];
  return median > 0 ? times[0] / median : 1;
}

double fastest_half_second(const Motion& motion) {
  constexpr double kSpan = 0.5;  // s, as the name says
  double fastest = 0;
  size_t from = 0;
  for (size_t i = 0; i < motion.time.size(); ++i) {
    if (!known(motion.joints[i][Joint::kPelvis])) from = i + 1;
    while (from < i && motion.time[i] - motion.time[from + 1] >= kSpan - 1e-6) ++from;
    if (from >= i || motion.time[i] - motion.time[from] < kSpan - 1e-6) continue;
    const Eigen::Vector3d way =
        motion.joints[i][Joint::kPelvis] - motion.joints[from][Joint::kPelvis];
    fastest = std::max(fastest, way.head<2>().norm() / (motion.time[i] - motion.time[from]));
  }
  return fastest;
}

}  // namespace

Plausibility plausibility(const Motion& motion, const Gait& gait) {
  Plausibility out;
  add_slides(motion, gait, out);
  add_penetration(motion, out);
  out.jitter = mean_jerk(motion);
  add_steps(motion, gait, out);
  out.quickest_step = quickest_step(gait);
  out.missing_steps = missing_steps(gait);
  out.fastest = fastest_half_second(motion);
  return out;
}

}  // namespace metrics
}  // namespace walktrack
