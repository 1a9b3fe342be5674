#include "tracker/others/person_boxes.h"

#include <algorithm>
#include <cstdlib>
#include <vector>

#include "observation/silhouette/hidden_pixels.h"

namespace walktrack {
inline namespace tracker {

namespace {

using Eigen::Vector2d;

// By hand, chosen on pedestrians of PETS (reports/other_people.md): margins of the boxes around the
// person whose evidence is wanted, around others, and around what is certainly theirs, m; how much
// further away somebody clearly is, m; how far, in half boxes, the middles of two boxes are apart
// if people overlap.
constexpr double kOwnMargin = 0.35, kOtherMargin = 0.3, kCoreMargin = 0.12;
constexpr double kInFront = 0.5;
constexpr double kOverlapping = 1.2;

// How far from the middle of a box a pixel is; 1 at its border.
double off_middle(const PixelRect& box, int x, int y) {
  return std::max(std::abs(2 * x - box.x0 - box.x1) / static_cast<double>(box.width()),
                  std::abs(2 * y - box.y0 - box.y1) / static_cast<double>(box.height()));
}

class PixelSet {
 public:
  explicit PixelSet(const PixelRect& area)
      : mask_{area, std::vector<uint8_t>(static_cast<size_t>(area.width()) *
                                         static_cast<size_t>(area.height()))} {}

  // Adds the pixels of a box that belong to the set.
  template <typename F>
  void add(const PixelRect& box, const F& belongs) {
    const PixelRect inside = intersection(box, mask_.area);
    for (int y = inside.y0; y < inside.y1; ++y)
      for (int x = inside.x0; x < inside.x1; ++x)
        if (belongs(x, y)) mask_.set[index(x, y)] = 1;
  }
  void add(const PixelRect& box) {
    add(box, [](int, int) { return true; });
  }
  const PixelMask& mask() const { return mask_; }

 private:
  size_t index(int x, int y) const {
    return static_cast<size_t>(y - mask_.area.y0) * static_cast<size_t>(mask_.area.width()) +
           static_cast<size_t>(x - mask_.area.x0);
  }
  PixelMask mask_;
};

}  // namespace

PixelRect person_box(const TrackContext& context, size_t camera, const Vector2d& place,
                     double margin) {
  return person_region(context.scene.cameras[camera], place, context.body().subject.height, margin)
      .area;
}

bool behind_one_another(const TrackContext& context, const Vector2d& one, const Vector2d& other) {
  bool both = false;
  for (size_t c = 0; c < context.scene.cameras.size(); ++c) {
    const PixelRect a = person_box(context, c, one, kOtherMargin),
                    b = person_box(context, c, other, kOtherMargin);
    if (a.empty() || b.empty()) continue;
    both = true;
    if (off_middle(a, (b.x0 + b.x1) / 2, (b.y0 + b.y1) / 2) > kOverlapping) return false;
  }
  return both;
}

SceneEvidence outlines_of(const SceneEvidence& evidence) {
  SceneEvidence out(evidence.size());
  for (size_t c = 0; c < out.size(); ++c) {
    out[c].planes = evidence[c].planes;
    out[c].pixel_weight = evidence[c].pixel_weight;
  }
  return out;
}

void hide_others(const TrackContext& context, std::span<const Vector2d> others,
                 const Vector2d& place, SceneEvidence& evidence) {
  for (size_t c = 0; c < evidence.size(); ++c) {
    LogRatioPlanes& planes = evidence[c].planes;
    if (planes.count == 0) continue;
    const PixelRect own = person_box(context, c, place, kOwnMargin);
    const Vector2d camera = camera_centre(context.scene.cameras[c]).head<2>();
    PixelSet hidden(planes.area);
    for (const Vector2d& other : others) {
      const PixelRect theirs = person_box(context, c, other, kOtherMargin);
      const double behind = (other - camera).norm() - (place - camera).norm();
      hidden.add(theirs, [&](int x, int y) {
        const double off_own = own.empty() ? 1 : off_middle(own, x, y);
        return off_own >= 1 || (behind < kInFront && off_middle(theirs, x, y) < off_own);
      });
      if (behind < -kInFront) hidden.add(person_box(context, c, other, kCoreMargin));
    }
    hide(hidden.mask(), planes);
  }
}

void hide_people(const TrackContext& context, std::span<const Vector2d> people, double margin,
                 SceneEvidence& evidence) {
  for (size_t c = 0; c < evidence.size(); ++c) {
    LogRatioPlanes& planes = evidence[c].planes;
    if (planes.count == 0) continue;
    PixelSet hidden(planes.area);
    for (const Vector2d& place : people) hidden.add(person_box(context, c, place, margin));
    hide(hidden.mask(), planes);
  }
}

}  // namespace tracker
}  // namespace walktrack
