#include "observation/silhouette/silhouette.h"

#include <algorithm>

#include "observation/silhouette/visible_rows.h"

namespace walktrack {
inline namespace observation {

double silhouette_log_ratio(const LogRatioPlanes& planes, const CapsuleList& capsules) {
  if (planes.count == 0 || planes.area.empty()) return 0;
  std::array<int, kMaxCapsules> plane;
  for (size_t i = 0; i < capsules.size(); ++i)
    plane[i] = planes.plane_of[static_cast<size_t>(capsules[i].appearance)];
  int64_t sum = 0;
  visit_visible(planes.area, capsules, [&](int row, int begin, int end, size_t capsule) {
    const int32_t* const prefix = planes.row(plane[capsule], row).data();
    sum += prefix[end] - prefix[std::min(begin, end)];
  });
  return static_cast<double>(sum) / LogRatioPlanes::kNat;
}

std::vector<VisibleRun> visible_runs(const PixelRect& area, const CapsuleList& capsules) {
  std::vector<VisibleRun> runs;
  if (area.empty()) return runs;
  runs.reserve(4 * static_cast<size_t>(area.height()));  // trunk and limbs side by side
  visit_visible(area, capsules, [&](int row, int begin, int end, size_t capsule) {
    if (begin < end)
      runs.push_back({row, area.x0 + begin, area.x0 + end, static_cast<int>(capsule)});
  });
  return runs;
}

}  // namespace observation
}  // namespace walktrack
