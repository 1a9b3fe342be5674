// Tests by the motion in the images whether the cameras of a scene are synchronous.
#pragma once

#include <vector>

#include "core/job_control.h"
#include "io/scene/scene.h"
#include "jobs/check/check_report.h"
#include "observation/figures/moving_figure.h"

namespace walktrack {
inline namespace jobs {

// Whether the scene leaves the lag between two cameras to be estimated from the walk.
bool starts_are_open(const Scene& scene);

// The paths of the moving figures, by camera, from the first frame on, at most kMostSyncFrames.
struct SeenFigures {
  double frame_rate = 0;  // of the scene, Hz
  std::vector<FigurePath> paths;
};
SeenFigures figures_in(const Scene& scene, const JobControl& control);
inline constexpr int kMostSyncFrames = 300;

void check_steps(const Scene& scene, const JobControl& control, CheckReport& report);

}  // namespace jobs
}  // namespace walktrack
