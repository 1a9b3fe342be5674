// A motion: joint centres over time, as joints.csv holds it. It is what is tracked, rendered and
// evaluated; what nobody knows is NaN.
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

// Motions over the same times that are as likely as another one, handed out one at a time: each is
// as long as the video.
struct Ensemble {
  size_t size = 0;
  std::function<Motion(size_t index)> member{};
};
Ensemble ensemble_of(std::vector<Motion> members);

// All joints unknown.
JointPositions unknown_joints();

// Median time between rows, s. Throws InputError for fewer than two rows.
double sample_period(const Motion& motion);

// The stature whose thighs and shanks are as long as the motion's; the default subject's if none is
// known. Metres.
double stature_of(const Motion& motion);

// The motion at other times (increasing): each joint by the cubic through its two known neighbours
// with slopes of central differences (Catmull & Rom 1974), by the line through them where a slope
// is unknown. A row of the motion at one of the times comes through unchanged. Unknown outside the
// motion and between rows further apart than `longest_gap` seconds.
Motion resampled(const Motion& motion, std::span<const double> times, double longest_gap);

}  // namespace body
}  // namespace walktrack
