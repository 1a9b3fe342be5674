#include "observation/background/foreground_grid.h"

#include <algorithm>

namespace walktrack {
inline namespace observation {

namespace {

// Adds to each cell the number of the row's pixels that look like a body in one of the planes.
void count_row(const LogRatioPlanes& planes, int y, int cell_px, std::vector<int>& counts) {
  for (size_t cell = 0; cell < counts.size(); ++cell) {
    const size_t from = cell * static_cast<size_t>(cell_px);
    for (size_t x = from; x < from + static_cast<size_t>(cell_px); ++x) {
      int32_t best = planes.row(0, y)[x + 1] - planes.row(0, y)[x];
      for (int plane = 1; plane < planes.count; ++plane)
        best = std::max(best, planes.row(plane, y)[x + 1] - planes.row(plane, y)[x]);
      counts[cell] += best > 0;
    }
  }
}

}  // namespace

ForegroundGrid foreground_grid(const LogRatioPlanes& planes, int cell_px) {
  if (planes.count == 0) return {};
  ForegroundGrid out{planes.area.width() / cell_px, planes.area.height() / cell_px, {}};
  std::vector<int> counts(static_cast<size_t>(out.columns));
  for (int row = 0; row < out.rows; ++row) {
    std::fill(counts.begin(), counts.end(), 0);
    for (int k = 0; k < cell_px; ++k)
      count_row(planes, planes.area.y0 + row * cell_px + k, cell_px, counts);
    for (const int count : counts) out.covered.push_back(2 * count > cell_px * cell_px);
  }
  return out;
}

int newly_covered(const ForegroundGrid& now, const ForegroundGrid& before) {
  if (now.columns != before.columns || now.rows != before.rows) return 0;
  int count = 0;
  for (size_t i = 0; i < now.covered.size(); ++i) count += now.covered[i] && !before.covered[i];
  return count;
}

}  // namespace observation
}  // namespace walktrack
