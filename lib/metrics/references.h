// Errors relative to measurements that people make by hand in a video: foot plants and ground
// points. Metres, seconds.
#pragma once

#include <limits>
#include <vector>

#include <Eigen/Core>

#include "body/motion.h"
#include "metrics/statistics/statistics.h"

namespace walktrack {
inline namespace metrics {

// A foot on the ground from `on` to `off`, with the middle of the foot at x = `place` (the walk is
// along x).
struct FootPlant {
  Side side;
  double on, off;
  double place;
};

struct FootPlantError {
  // The plant's foot is within 0.25 m of it over the stance, and nearer than the other foot.
  bool found = false;
  // Mean of |x of (ankle + toe) / 2 - place| over the stance without `trim` at either end. NaN if
  // nothing of it is left or known.
  double error = std::numeric_limits<double>::quiet_NaN();
};

struct FootPlantErrors {
  std::vector<FootPlantError> plants;  // in the order of the truth
  size_t found = 0;
  double mean_error = std::numeric_limits<double>::quiet_NaN();  // over plants that have one
};

// `trim`: seconds at either end of a stance that are not used (heel strike and heel-off).
FootPlantErrors foot_plant_errors(const std::vector<FootPlant>& truth, const Motion& estimate,
                                  double trim);

struct GroundPoints {
  std::vector<double> time;  // s, increasing
  std::vector<Eigen::Vector2d> points;
};

struct GroundErrors {
  size_t frames = 0;        // of the truth, from the first filled one on
  double filled_share = 0;  // of those
  ErrorStatistics distance;
};

// Distance on the ground between the pelvis and the truth.
GroundErrors ground_errors(const GroundPoints& truth, const Motion& estimate);

}  // namespace metrics
}  // namespace walktrack
