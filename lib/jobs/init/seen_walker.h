// Positions of head and feet of a walking person in the video of an uncalibrated camera: from
// pixels that differ from the background and, if the program has the pose network, only in places
// where the network detects a person.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "camera/view_from_walker.h"
#include "core/job_control.h"
#include "jobs/init/figure_tracks.h"
#include "jobs/init/init.h"

namespace walktrack {
inline namespace jobs {

struct SeenWalk {
  int width_px = 0, height_px = 0;
  double frame_rate = 0;  // Hz
  double looks_hz = 0;    // rate of the frames that are searched
  std::vector<SeenFigure> figures;
};

// InputError that names the video if it has no frame rate. At most a minute with a person in it is
// searched.
SeenWalk seen_walk(const InitJob& job, const JobControl& control);

// A mean over a part of the walk that lasts about a stride, with the time of its middle. Frames in
// which somebody is partly hidden or joined to another foreground region are ignored.
struct WalkerPosition {
  SeenStature seen;
  double time;
};
std::vector<WalkerPosition> stride_positions(std::span<const SeenFigure> figures, double looks_hz);

}  // namespace jobs
}  // namespace walktrack
