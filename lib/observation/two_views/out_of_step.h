// Tests whether three or more cameras are synchronous, by the vertical planes through the figure.
#pragma once

#include <optional>
#include <vector>

#include "camera/camera.h"
#include "observation/figures/moving_figure.h"

namespace walktrack {
inline namespace observation {

// Cameras that are not synchronous, found from three or more paths: the vertical planes through the
// figure, seen by all cameras at one time, meet in one line. Every single camera for which a lag
// makes them meet is listed, the best first; with three cameras there may be several. Empty if the
// cameras agree or if there is too little evidence.
struct OutOfStep {
  size_t camera;
  int frames_late;               // positive: it shows everything later than the others
  double gap_before, gap_after;  // m, distance by which the planes miss each other
};
std::vector<OutOfStep> find_out_of_step(const std::vector<Camera>& cameras,
                                        const std::vector<FigurePath>& paths);

}  // namespace observation
}  // namespace walktrack
