#include "observation/background/seen_colours.h"

#include <cmath>

#include "observation/silhouette/silhouette.h"

namespace walktrack {
inline namespace observation {

AppearanceModel::Counts colours_inside(const CapsuleList& parts, const LogRatioPlanes& planes,
                                       const AppearanceModel& model, const BinAt& bin_at) {
  AppearanceModel::Counts counts = model.empty_counts();
  for (const VisibleRun& run : visible_runs(planes.area, parts)) {
    const Appearance appearance = parts[static_cast<size_t>(run.capsule)].appearance;
    const auto cls = static_cast<size_t>(model.class_of()[static_cast<size_t>(appearance)]);
    for (int x = run.x0; x < run.x1; ++x) {
      const std::optional<uint16_t> bin = bin_at(x, run.y);
      if (!bin) continue;
      const double foreground = 1 / (1 + std::exp(-log_ratio_at(planes, appearance, x, run.y)));
      counts.weights[cls][*bin] += static_cast<float>(foreground);
      counts.seen[cls] += 1;
    }
  }
  return counts;
}

void compare_with(const AppearanceModel& model, const SeenColours& seen, const PixelRect& area,
                  double clip, LogRatioPlanes& planes) {
  const bool learned = model.any_learned();
  planes.plane_of = learned ? model.class_of() : std::array<int, kAppearanceCount>{};
  resize(planes, area, learned ? model.classes() : 1);
  constexpr auto kNat = static_cast<float>(LogRatioPlanes::kNat);
  std::vector<float> ratio(static_cast<size_t>(area.width()));
  for (int y = area.y0; y < area.y1; ++y) {
    const size_t row = seen.index(area.x0, y);
    for (int plane = 0; plane < planes.count; ++plane) {
      const ColourTable& table = model.table(plane);
      for (size_t i = 0; i < ratio.size(); ++i) {
        const int16_t behind = seen.behind[row + i];
        ratio[i] = behind == SeenColours::kUnknown
                       ? 0
                       : table[seen.bin[row + i]] - static_cast<float>(behind) / kNat;
      }
      set_row(planes, plane, y, ratio, clip);
    }
  }
}

}  // namespace observation
}  // namespace walktrack
