// The places of head and feet of a walking person in a video whose camera is not known: from pixels
// that differ from the background and, if the program has the pose network, only where the network
// detects a person.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "camera/view_from_walker.h"
#include "core/job_control.h"
#include "jobs/init/figure_tracks.h"
#include "jobs/init/init.h"

namespace walktrack {
inline namespace jobs {

struct SeenWalk {
  int width_px = 0, height_px = 0;
  double frame_rate = 0;  // Hz
  double looks_hz = 0;    // frames looked at in a second
  std::vector<SeenFigure> figures;
};

// InputError naming the video where it has no frame rate. At most a minute in which somebody is
// seen is looked at.
SeenWalk seen_walk(const InitJob& job, const JobControl& control);

// Means over pieces of the walk that last about a stride; frames in which somebody is half hidden
// or grown together with something are passed over. With the time of its middle.
struct WalkerPosition {
  SeenStature seen;
  double time;
};
std::vector<WalkerPosition> stride_positions(std::span<const SeenFigure> figures, double looks_hz);

}  // namespace jobs
}  // namespace walktrack
