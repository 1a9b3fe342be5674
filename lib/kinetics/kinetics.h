// Forces of a motion by inverse dynamics: ground reactions, joint moments, and work.
//
// Joint centres are smoothed (smoothing.h), the subject becomes a tree of links that fits them
// (linked_body.h), and recursive Newton-Euler (mechanics/articulated_dynamics.h) gives the wrench
// that is missing at the root: the ground reaction. It is distributed over the feet
// (ground_contact.h) and applied to them as loads; the recursion then gives the joint moments.
//
// Signs: a moment is that of the muscles and ligaments, positive in the direction of its angle (hip
// flexion, abduction; knee flexion; ankle dorsiflexion), so that a calf that pushes off has a
// negative ankle moment. Power is moment . relative angular velocity in all three axes; positive
// power does work on the body. The distribution in double support follows from the stated rules,
// not from the motion; co-contraction and soft tissue are not modelled. World axes, ground z = 0,
// SI.
#pragma once

#include <array>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "body/motion.h"
#include "body/subject.h"
#include "kinetics/ground_contact.h"

namespace walktrack {
inline namespace kinetics {

struct KineticsConfig {
  // Of the smoothing; walking has 99 % of its power below 6 Hz (Winter 2009, section 3.4.3).
  double cutoff_hz = 6;  // 0: none
  // The same for tracked motions, whose accelerations have an error at all frequencies.
  // reports/force_plates.md has the measurement.
  double tracked_cutoff_hz = 3;
};

// Standard deviation of a loaded foot's vertical load from a tracked motion, in body weights, at
// tracked_cutoff_hz: of two trials on force plates (reports/force_plates.md).
inline constexpr double kTrackedLoadError = 0.13;

struct LegLoads {
  double hip_flexion = 0, hip_abduction = 0, knee_flexion = 0, ankle_dorsiflexion = 0;  // N m
  double hip_power = 0, knee_power = 0, ankle_power = 0;                                // W
};

struct KineticsFrame {
  bool known = false;   // false if a joint was unknown or an interval too short
  Eigen::Vector3d com;  // m
  Wrench ground;        // of the ground on the body, as required by the motion
  std::array<FootLoad, 2> feet;
  std::array<LegLoads, 2> legs;
  double unexplained_force = 0;                     // N: required while no foot was on the ground
  double unexplained_moment = 0;                    // N m: the part that soles cannot transmit
  double kinetic_energy = 0, potential_energy = 0;  // J; potential 0 at the ground
};

struct KineticsTotals {
  double distance = 0;           // m, of the centre of mass over the ground
  double positive_work = 0;      // J, of hips, knees and ankles, summed over joints
  double negative_work = 0;      // J, <= 0
  double cost_of_transport = 0;  // positive_work / (mass g distance); NaN without distance
  double peak_load = 0;          // largest vertical load of a foot, body weights
};

struct Kinetics {
  std::vector<double> time;           // s, those of the motion
  std::vector<KineticsFrame> frames;  // one for each time
  KineticsTotals totals;
};

// Shortest interval of rows with a known body that is differentiated.
inline constexpr size_t kShortestSpan = 8;

// `gravity` in m/s^2; a slope tilts it.
Kinetics kinetics_of(const Motion& motion, std::span<const FootContact> contacts,
                     const Subject& subject, const Eigen::Vector3d& gravity,
                     const KineticsConfig& config);

}  // namespace kinetics
}  // namespace walktrack
