// A frame's foreground in coarse cells, which suffices to detect motion.
#pragma once

#include <cstdint>
#include <vector>

#include "observation/silhouette/planes.h"

namespace walktrack {
inline namespace observation {

struct ForegroundGrid {
  int columns = 0, rows = 0;
  std::vector<uint8_t> covered;  // by row: whether most of the cell's pixels look like a body
};

// Cells are squares of `cell_px`; a remainder at the right and at the bottom is ignored. There are
// no cells without planes.
ForegroundGrid foreground_grid(const LogRatioPlanes& planes, int cell_px);

// Cells that are covered now and were not before; 0 if the grids are of different areas.
int newly_covered(const ForegroundGrid& now, const ForegroundGrid& before);

}  // namespace observation
}  // namespace walktrack
