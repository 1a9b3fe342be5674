// Whether three cameras and more are in step, from the vertical planes through the figure.
#pragma once

#include <optional>
#include <vector>

#include "camera/camera.h"
#include "observation/figures/moving_figure.h"

namespace walktrack {
inline namespace observation {

// Cameras out of step, found from three or more paths: the vertical planes through the figure, seen
// by all cameras at one instant, meet in one line. Every single camera that could be shifted to
// make them meet is listed, the best first; with three cameras there may be several.
// Empty if the cameras agree or nothing can be said.
struct OutOfStep {
  size_t camera;
  int frames_late;               // positive: it shows things later than the others
  double gap_before, gap_after;  // m, how far the planes miss each other
};
std::vector<OutOfStep> find_out_of_step(const std::vector<Camera>& cameras,
                                        const std::vector<FigurePath>& paths);

}  // namespace observation
}  // namespace walktrack
