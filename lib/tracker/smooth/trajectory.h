// The most probable trajectory: the poses of all frames of a track, estimated together.
//
// Over poses x_t, and a place p on the ground for each period in which a sole lies flat, it
// minimises
//   sum_t     k [ 1/2 d' H_t d - d' (x*_t - m_t) / s^2 ],  d = x_t - x*_t      the images
//   (image_information.h)
//   + 1/2 sum_t    w_t |(x_t - m_t) / s|^2                                     the walker
//   + 1/2 sum_t    |x_(t-1) - 2 x_t + x_(t+1)|^2 / v                           people's
//   accelerations
//   + 1/2 sum_walk q_t |a(x_t)|^2                                              their legs, seen
//   along the walk (walk_prior.h)
//   + 1/2 sum_flat |(f(x_t) - p) / c|^2 + h_t |(heights(x_t) - flat) / b|^2    flat soles do not
//   move
//   + 1/2 sum_t    max(0, -toe height)^2 / c^2                                 no toe in the ground
// k = 1, or less where frames follow each other in less than 1/30 s; m_t the particles' mean, s
// the deviations of people's poses from a walker's, without the place over the ground, which the
// particles only know from the same images; v = 4/3 a^2 tau dt^3 of accelerations of a, correlated
// for tau, and less across the walk than along it; f the middle of the foot over the ground. Gauss
// and Newton's steps, by one sparse factorisation each: the trajectory of space-time constraints
// (Witkin & Kass, SIGGRAPH 1988), with images in place of an objective, and as a Kalman smoother
// the linear part of it (Rauch, Tung & Striebel 1965).
//
// With the sum's curvature there, the poses are the mean of a normal distribution (Laplace's
// approximation). Its draws are whole trajectories: bands of joints, angles, gait and forces
// come from them (tracker/smooth/posterior.h). tracker/reports/reported_pose.md says what the
// trajectory gains, and what else was tried. Metres, radians, world axes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "body/flat_foot.h"
#include "tracker/walk_prior.h"
#include "tracker/walker_filter.h"

namespace walktrack {
inline namespace tracker {

struct SmoothingConfig {
  bool enabled = true;  // all frames are estimated together
  bool plant = true;    // supporting feet do not move
};

// A foot that moves further than this in a period does not stand: the legs were swapped or lost
// there. Such periods have to be left out. By hand.
inline constexpr double kTooFarToStand = 0.4;  // m

using Poses = std::vector<Pose>;

// Frames that are all tracked, `dt` s apart, and the periods of flat soles among them. The poses
// of the first `settled` frames are taken as they are reported, as are those of their draws.
struct TrajectoryFrames {
  double dt;
  std::span<const FrameRecord> records;
  std::span<const FlatFoot> flat = {};
  size_t settled = 0;
  // By frame, the direction of the walk, with which what is known of walks counts; or none.
  std::span<const WalkingDirection> ways = {};
};

// Which draws are wanted: one for each element of `settled`, which has its poses of the settled
// frames. `seed` and `part` name the random numbers.
struct WantedDraws {
  std::span<const Poses> settled;
  uint64_t seed = 0;
  uint32_t part = 0;
};

struct TrajectoryEstimate {
  Poses poses;
  std::vector<Poses> draws;
};

TrajectoryEstimate most_probable_trajectory(const BodyModel& model, const TrajectoryFrames& frames,
                                            const WantedDraws& wanted = {});

}  // namespace tracker
}  // namespace walktrack
