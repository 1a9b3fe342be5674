// The colours of a frame's pixels and how probable they are without the subject. They are kept
// while a walk is searched (Region::picture): when one has been found, the subject's colours are
// learned from the window's frames, and the frames are compared with them
// (tracker/detect/clothes.h).
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "observation/background/appearance.h"
#include "observation/silhouette/capsules.h"
#include "observation/silhouette/planes.h"

namespace walktrack {
inline namespace observation {

struct SeenColours {
  // Of a pixel without evidence.
  static constexpr int16_t kUnknown = std::numeric_limits<int16_t>::min();

  PixelRect area;
  std::vector<uint16_t> bin;    // ColourBins, row by row
  std::vector<int16_t> behind;  // log density under the background, 1 / LogRatioPlanes::kNat nats
  bool colourless = false;      // PictureChange::colourless

  bool empty() const { return bin.empty(); }
  size_t index(int x, int y) const {
    return static_cast<size_t>(y - area.y0) * static_cast<size_t>(area.width()) +
           static_cast<size_t>(x - area.x0);
  }
  std::optional<uint16_t> bin_at(int x, int y) const {
    const size_t i = index(x, y);
    return behind[i] == kUnknown ? std::nullopt : std::optional(bin[i]);
  }
};

// The bin of a pixel's colour; nullopt without evidence.
using BinAt = std::function<std::optional<uint16_t>(int x, int y)>;

// The pixels of a frame in which the parts are visible, each as probable as the frame's log-ratios
// say, for the model to learn from.
AppearanceModel::Counts colours_inside(const CapsuleList& parts, const LogRatioPlanes& planes,
                                       const AppearanceModel& model, const BinAt& bin_at);

// Replaces the planes by the log-ratios of the pixels of `area`, a part of that of the colours,
// each clipped to +-clip nats. A model that has learned nothing has one plane for all parts.
void compare_with(const AppearanceModel& model, const SeenColours& seen, const PixelRect& area,
                  double clip, LogRatioPlanes& planes);

}  // namespace observation
}  // namespace walktrack
