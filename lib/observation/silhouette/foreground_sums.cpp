#include "observation/silhouette/foreground_sums.h"

#include <algorithm>

namespace walktrack {
inline namespace observation {

ForegroundSums::ForegroundSums(const LogRatioPlanes& planes, std::span<const PixelRect> but) {
  if (planes.count == 0) return;
  area_ = planes.area;
  const auto width = static_cast<size_t>(area_.width());
  integral_.assign((width + 1) * (static_cast<size_t>(area_.height()) + 1), 0);
  std::vector<float> ratios(width);
  double* above = integral_.data();
  for (int y = area_.y0; y < area_.y1; ++y) {
    best_ratios(planes, y, ratios);
    for (const PixelRect& box : but) {
      const PixelRect inside = intersection(box, {area_.x0, y, area_.x1, y + 1});
      if (!inside.empty())
        std::fill(ratios.begin() + (inside.x0 - area_.x0), ratios.begin() + (inside.x1 - area_.x0),
                  0.0F);
    }
    double* const row = above + width + 1;
    double sum = 0;
    for (size_t x = 0; x < width; ++x) {
      sum += std::max(0.0F, ratios[x]);
      row[x + 1] = above[x + 1] + sum;
    }
    above = row;
  }
}

double ForegroundSums::within(const PixelRect& box) const {
  const PixelRect inside = intersection(box, area_);
  if (integral_.empty() || inside.empty()) return 0;
  const auto stride = static_cast<size_t>(area_.width()) + 1;
  const auto at = [&](int x, int y) {
    return integral_[static_cast<size_t>(y - area_.y0) * stride +
                     static_cast<size_t>(x - area_.x0)];
  };
  return at(inside.x1, inside.y1) - at(inside.x0, inside.y1) - at(inside.x1, inside.y0) +
         at(inside.x0, inside.y0);
}

}  // namespace observation
}  // namespace walktrack
