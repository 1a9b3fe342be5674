#include "observation/silhouette/overlap.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "observation/silhouette/silhouette.h"

namespace walktrack {
inline namespace observation {

namespace {

PixelRect bounding_box(std::span<const VisibleRun> runs) {
  PixelRect box{runs[0].x0, runs[0].y, runs[0].x1, runs[0].y + 1};
  for (const VisibleRun& run : runs) {
    box.x0 = std::min(box.x0, run.x0);
    box.x1 = std::max(box.x1, run.x1);
    box.y0 = std::min(box.y0, run.y);
    box.y1 = std::max(box.y1, run.y + 1);
  }
  return box;
}

PixelRect widened(const PixelRect& box) {
  const auto by = static_cast<int>(std::lround(kNearMargin * std::max(box.width(), box.height())));
  return {box.x0 - by, box.y0 - by, box.x1 + by, box.y1 + by};
}

// For each pixel of a row, the largest log-ratio over the appearances of a body, in fixed point.
void best_of_planes(const LogRatioPlanes& planes, const PixelRect& box, int y,
                    std::span<int32_t> out) {
  const auto from = static_cast<size_t>(box.x0 - planes.area.x0);
  for (int plane = 0; plane < planes.count; ++plane) {
    const int32_t* const sum = planes.row(plane, y).data() + from;
    if (plane == 0) {
      for (size_t i = 0; i < out.size(); ++i) out[i] = sum[i + 1] - sum[i];
    } else {
      for (size_t i = 0; i < out.size(); ++i) out[i] = std::max(out[i], sum[i + 1] - sum[i]);
    }
  }
}

}  // namespace

Overlap overlap(const LogRatioPlanes& planes, const CapsuleList& figure,
                std::span<const CapsuleList> unmodelled) {
  if (planes.count == 0) return {};
  const std::vector<VisibleRun> runs = visible_runs(planes.area, figure);
  if (runs.empty()) return {};
  const PixelRect box = intersection(widened(bounding_box(runs)), planes.area);
  const auto width = static_cast<size_t>(box.width());
  std::vector<int32_t> best(width * static_cast<size_t>(box.height()));
  const auto row = [&](int y) {
    return std::span(best).subspan(width * static_cast<size_t>(y - box.y0), width);
  };
  for (int y = box.y0; y < box.y1; ++y) best_of_planes(planes, box, y, row(y));
  int64_t both = 0, against = 0, missed = 0, pixels = 0, seen = 0;
  const auto take = [&](const VisibleRun& run) {
    return row(run.y).subspan(static_cast<size_t>(run.x0 - box.x0),
                              static_cast<size_t>(run.x1 - run.x0));
  };
  for (const VisibleRun& run : runs) {
    for (int32_t& value : take(run)) {
      both += std::max(value, 0);
      against -= std::min(value, 0);
      seen += value != 0;
      ++pixels;
      value = 0;
    }
  }
  for (const CapsuleList& parts : unmodelled)
    for (const VisibleRun& run : visible_runs(box, parts)) std::ranges::fill(take(run), 0);
  for (const int32_t value : best) missed += std::max(value, 0);
  constexpr double kNat = LogRatioPlanes::kNat;
  return {double(both) / kNat, double(against) / kNat, double(missed) / kNat,
          double(seen) / double(std::max<int64_t>(pixels, 1))};
}

}  // namespace observation
}  // namespace walktrack
