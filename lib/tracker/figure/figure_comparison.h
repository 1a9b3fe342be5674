// Which of several figures explains the outlines of a start before one camera best: bodies of
// other breadths or lengths in the poses that the start has found.
//
// The figures with which a walk is searched do not tell: they are not in step and have no arms.
// Nats; angles in radians, lengths in metres.
#pragma once

#include <deque>
#include <functional>
#include <span>

#include "tracker/tracker_scene.h"
#include "tracker/walker_filter.h"

namespace walktrack {
inline namespace tracker {

// The poses of a start's first frames, and the frames, which have evidence of one camera. Frames
// that are not tracked tell nothing.
struct StartPoses {
  const TrackerScene& scene;
  const std::deque<SceneEvidence>& window;
  std::span<const FrameRecord> records;
};

// Log-likelihood of the outlines if the poses are those of this body.
double outlines_score(const StartPoses& start, const Body& body);

// Values that are tried: from one of them on, a step apart, within limits.
struct ComparedValues {
  double from, step, least, most;
};

// The value with the largest score next to `from`: a parabola through the best one of those that
// are tried and its neighbours has its top there. At a limit it is the limit.
double best_value(const ComparedValues& values, const std::function<double(double)>& score);

}  // namespace tracker
}  // namespace walktrack
