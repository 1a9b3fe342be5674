// Distributes one ground reaction over two feet.
//
// A motion determines the sum of all ground forces and their moment, not their distribution over
// two feet. In single support one foot takes all. In double support (from the leading foot's strike
// to the trailing foot's toe-off):
//   vertical    the leading foot's share of the load rises from 0 to 1 (load_shares)
//   centres     start from the trailing foot's ball and the leading foot's ankle and move together,
//               so that their weighted mean is the centre of pressure of the whole
//   horizontal  each force points from its foot to the body's centre of mass, as forces in walking
//               nearly do; what is then missing from the sum is added by the shares
//   free moment about the vertical, by the shares
// Each rule is continuous with single support before and after. World axes, ground z = 0.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <span>

#include <Eigen/Core>

#include "body/pose.h"

namespace walktrack {
inline namespace kinetics {

struct FootContact {
  Side side;
  double on, off;  // s
};

struct LoadShares {
  std::array<double, 2> of;  // the vertical load, by Side; sum 1
  Side leading;              // the foot that landed last
};

// nullopt in flight. In a gap shorter than kShortestFlight between two contacts (an event that was
// detected too early or too late) the nearer foot carries all.
inline constexpr double kShortestFlight = 0.1;  // s; walking has none
std::optional<LoadShares> load_shares(std::span<const FootContact> contacts, double t);

struct FootPlace {
  Eigen::Vector2d ankle, ball;  // from above, m
};

struct Wrench {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   // N, of the ground on the body
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  // N m, about the world's origin
};

struct FootLoad {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();  // N, of the ground on the foot
  Eigen::Vector2d centre =                          // m, of pressure; NaN where nothing presses
      Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
  double free_moment = 0;  // N m, about the vertical through the centre
};

struct GroundLoads {
  std::array<FootLoad, 2> feet;  // by Side
  double unexplained = 0;        // N m, the part of the moment that soles of human length cannot
                                 // transmit
};

// The loads of the feet whose sum is `whole`, except for the unexplained moment. Centres of
// pressure are limited to the soles (heel to toes, five centimetres to either side).
GroundLoads shared_loads(const Wrench& whole, const LoadShares& shares,
                         const std::array<FootPlace, 2>& places, const Eigen::Vector3d& com);

// The sum of the feet's loads as one wrench.
Wrench sum_of(const std::array<FootLoad, 2>& feet);

}  // namespace kinetics
}  // namespace walktrack
