#include "observation/silhouette/planes.h"

#include <algorithm>
#include <cmath>

namespace walktrack {
inline namespace observation {

PixelRect intersection(const PixelRect& a, const PixelRect& b) {
  return {std::max(a.x0, b.x0), std::max(a.y0, b.y0), std::min(a.x1, b.x1), std::min(a.y1, b.y1)};
}

void resize(LogRatioPlanes& planes, const PixelRect& area, int count) {
  planes.area = area;
  planes.count = count;
  planes.prefix.resize(planes.stride() * static_cast<size_t>(area.height()) *
                       static_cast<size_t>(count));
}

void set_row(LogRatioPlanes& planes, int plane, int y, std::span<const float> log_ratios,
             double clip) {
  const auto limit = static_cast<float>(clip * LogRatioPlanes::kNat);
  const std::span<int32_t> out = planes.row(plane, y);
  int32_t sum = 0;
  out[0] = 0;
  for (size_t i = 0; i < log_ratios.size(); ++i) {
    const float value = log_ratios[i] * static_cast<float>(LogRatioPlanes::kNat);
    const float clipped = std::min(limit, std::max(-limit, value));
    sum += static_cast<int32_t>(clipped + std::copysign(0.5F, clipped));
    out[i + 1] = sum;
  }
}

void best_ratios(const LogRatioPlanes& planes, int y, std::span<float> out) {
  constexpr auto kUnit = static_cast<float>(1 / LogRatioPlanes::kNat);
  for (int plane = 0; plane < planes.count; ++plane) {
    const std::span<const int32_t> row = planes.row(plane, y);
    for (size_t x = 0; x < out.size(); ++x) {
      const float ratio = kUnit * static_cast<float>(row[x + 1] - row[x]);
      out[x] = plane == 0 ? ratio : std::max(out[x], ratio);
    }
  }
}

double log_ratio_at(const LogRatioPlanes& planes, Appearance appearance, int x, int y) {
  const PixelRect& area = planes.area;
  if (planes.count == 0 || x < area.x0 || x >= area.x1 || y < area.y0 || y >= area.y1) return 0;
  const auto row = planes.row(planes.plane_of[static_cast<size_t>(appearance)], y);
  const auto i = static_cast<size_t>(x - area.x0);
  return (row[i + 1] - row[i]) / LogRatioPlanes::kNat;
}

}  // namespace observation
}  // namespace walktrack
