// How to track: the configurations of the tracker's parts, each of which is where the part is.
#pragma once

#include "filter/particle_filter.h"
#include "tracker/detect/detector.h"
#include "tracker/modes/monitor.h"
#include "tracker/motion/propagate.h"
#include "tracker/start/start.h"

namespace walktrack {
inline namespace tracker {

// What is reported of a frame: the particles' mean, or the most probable pose near it
// (tracker/smooth/refinement.h).
enum class EstimateKind { kMean, kMap };

struct TrackerConfig {
  MotionConfig motion;
  FilterConfig filter;
  DetectorConfig detector;
  StartConfig start;
  MonitorConfig monitor;
  int samples = 20;        // particles kept of every frame to show the spread
  double model_error = 1;  // multiplies what bands hold beyond the particles' spread
  EstimateKind estimate = EstimateKind::kMap;
};

}  // namespace tracker
}  // namespace walktrack
