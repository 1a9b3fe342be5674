// A motion: joint centres over time, as in joints.csv, which is tracked, rendered and evaluated.
// Unknown values are NaN.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "body/pose.h"

namespace walktrack {
inline namespace body {

struct Motion {
  std::vector<double> time;            // s, increasing
  std::vector<JointPositions> joints;  // one for each time; a joint with a NaN is unknown
};

inline bool known(const Eigen::Vector3d& point) { return point.allFinite(); }

// Motions over the same times that are as likely as another one, returned one at a time, because
// each is as long as the video.
struct Ensemble {
  size_t size = 0;
  std::function<Motion(size_t index)> member{};
};
Ensemble ensemble_of(std::vector<Motion> members);

// All joints unknown.
JointPositions unknown_joints();

// Median time between rows, s. Throws InputError for fewer than two rows.
double sample_period(const Motion& motion);

// The stature, in metres, that fits the lengths of the motion's thighs and shanks; the default
// subject's if none is known.
double stature_of(const Motion& motion);

// The motion at other times (increasing): each joint is interpolated by the cubic through its two
// known neighbours with central differences as slopes (Catmull & Rom 1974), or linearly if a slope
// is unknown. A row of the motion at one of the times is not changed. Unknown outside the motion
// and between rows further apart than `longest_gap` seconds.
Motion resampled(const Motion& motion, std::span<const double> times, double longest_gap);

}  // namespace body
}  // namespace walktrack
