#include "observation/pose_net/pose_maps.h"

#include <cmath>

namespace walktrack {
inline namespace observation {

namespace {

constexpr float kNearness = 1.8f;  // cells

float sigmoid(float value) { return 1 / (1 + std::exp(-value)); }

struct Peak {
  size_t cell = 0;
  int x = 0, y = 0;
  float value = 0;  // after the logistic function, without the weight
};

// The cell with the largest value of a map weighted by the nearness to (x, y).
Peak peak_near(std::span<const float> map, int side, float x, float y) {
  Peak best;
  float highest = -1;
  size_t cell = 0;
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column, ++cell) {
      const float dx = static_cast<float>(column) - x, dy = static_cast<float>(row) - y;
      const float value = sigmoid(map[cell]);
      const float weighted = value / (std::sqrt(dx * dx + dy * dy) + kNearness);
      if (!(weighted > highest)) continue;
      highest = weighted;
      best = {cell, column, row, value};
    }
  }
  return best;
}

// The edge of the cut-out's first pixel is half a pixel before its centre.
float picture_px(float cells, int side, int from_px, int side_px) {
  return static_cast<float>(from_px) - 0.5f +
         cells / static_cast<float>(side) * static_cast<float>(side_px);
}

}  // namespace

DetectedPerson decoded(const PoseMaps& maps, const CutOut& cut_out) {
  const size_t cells = static_cast<size_t>(maps.side) * static_cast<size_t>(maps.side);
  const float half = 0.5f * static_cast<float>(maps.side);
  const Peak middle = peak_near(maps.centre, maps.side, half, half);
  DetectedPerson person;
  for (size_t k = 0; k < kCocoPoints; ++k) {
    const float y = static_cast<float>(middle.y) + maps.regress[2 * k * cells + middle.cell];
    const float x = static_cast<float>(middle.x) + maps.regress[(2 * k + 1) * cells + middle.cell];
    const Peak peak = peak_near(maps.heat.subspan(k * cells, cells), maps.side, x, y);
    const float place_y = static_cast<float>(peak.y) + maps.offset[2 * k * cells + peak.cell];
    const float place_x = static_cast<float>(peak.x) + maps.offset[(2 * k + 1) * cells + peak.cell];
    person.points[k] = {picture_px(place_x, maps.side, cut_out.x0, cut_out.side_px),
                        picture_px(place_y, maps.side, cut_out.y0, cut_out.side_px), peak.value};
  }
  return person;
}

}  // namespace observation
}  // namespace walktrack
