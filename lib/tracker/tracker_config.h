// The configuration of the tracker. The configurations of its parts are defined beside the parts.
#pragma once

#include <cstddef>

#include "filter/particle_filter.h"
#include "tracker/detect/detector_config.h"
#include "tracker/modes/monitor.h"
#include "tracker/motion/propagate.h"
#include "tracker/start/start.h"

namespace walktrack {
inline namespace tracker {

// The pose that is reported for a frame: the particles' mean, or the most probable pose near it
// (tracker/smooth/refinement.h).
enum class EstimateKind { kFilter, kMap };

// Particles that suffice (reports/particles.md): three cameras leave less open than one or two.
struct ParticleCounts {
  int filter = 0, start = 0;  // of a filter, and of each start hypothesis
};
inline constexpr ParticleCounts particles_for(size_t cameras) {
  return cameras > 2 ? ParticleCounts{100, 75} : ParticleCounts{200, 150};
}

struct TrackerConfig {
  MotionConfig motion;
  FilterConfig filter;
  DetectorConfig detector;
  StartConfig start;
  MonitorConfig monitor;
  int samples = 20;        // particles of every frame that are kept to show the spread
  double model_error = 1;  // factor on the part of the bands that is not the particles' spread
  EstimateKind estimate = EstimateKind::kMap;
  // Whether frames before several cameras are held back, so that a track whose legs switch, or
  // that leaves the legs, can be started again (tracker/start/new_start.h).
  bool start_again = true;
  // Whether other people near the subject are followed (tracker/others/nearby_people.h).
  bool others = true;
};

}  // namespace tracker
}  // namespace walktrack
