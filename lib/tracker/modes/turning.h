// Components that turn: filters that follow the subject beside the track and may replace it.
//
// Walkers keep their heading, because people mostly walk straight ahead and one camera hardly shows
// the heading. A track before one camera therefore loses somebody who turns: the figure walks on,
// away from them, while every single frame is still explained fairly well, and soon all particles
// descend from a few that face the wrong way. Walkers whose heading is free follow a turn, but
// wander where the subject walks straight ahead. So both follow, each in a filter of its own that
// is resampled apart (a mixture particle filter: Vermaak, Doucet & Perez, ICCV 2003). The
// components begin with the track's particles; after a while the one with the largest evidence
// replaces the track if it is clearly better, and they begin anew; earlier if the track is lost.
// Until then the frames are not reported. tracker/reports/feet_and_heading.md has measurements.
// Several cameras see the heading, and a sagittal path has no turns: there are no components there.
#pragma once

#include <vector>

#include "tracker/modes/filter_frame.h"

namespace walktrack {
inline namespace tracker {

struct TurningComponent {
  WalkerFilter filter;
  double yaw_rate_sd;  // rad/s
  uint64_t seed;
  double lead = 0;                     // log-evidence of its frames, less that of the track, nats
  std::vector<FrameRecord> records{};  // of its frames
};

struct TurningTrial {
  std::vector<TurningComponent> components;
  std::vector<FrameRecord> records{};  // of the track
};

// How many follow beside the track with so many cameras, and the configuration of each.
int turning_components(const MotionConfig& motion, Path path, size_t cameras);
FilterConfig component_config(FilterConfig filter);

// Components with the particles of the track, before frame number `frame`.
TurningTrial components_that_turn(const TrackContext& context, const WalkerFilter& track,
                                  uint32_t frame);

// Adds a frame, of which `record` is the track's; true if the trial has lasted long enough.
bool step(const TrackContext& context, const SceneEvidence& evidence, uint32_t frame,
          FrameRecord record, TurningTrial& trial);

// The component that replaces the track; null if none is clearly better.
TurningComponent* winner(TurningTrial& trial);

}  // namespace tracker
}  // namespace walktrack
