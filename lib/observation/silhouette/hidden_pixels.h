// Pixels in which something that stands still is in front of the subject, found from frames in
// which the subject comes out from behind it.
//
// Such a pixel looks like the empty scene whether or not the subject is there. Figures along the
// subject's way say with which probability c the subject covers a pixel in a frame. With
// l = log p(I | foreground) - log p(I | background), a frame is more likely by log(1 + c (e^l - 1))
// if nothing is in front of the subject than if something is; the sum over frames decides. Pixels
// near these that never look like a foreground belong to the same thing.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "observation/silhouette/capsules.h"
#include "observation/silhouette/planes.h"

namespace walktrack {
inline namespace observation {

struct CoveredFrame {
  const LogRatioPlanes* planes;
  std::vector<CapsuleList> figures;  // one of which is the subject, each with the same probability
};

// The share of a figure's pixels that look like the empty scene, mean over the figures; 0 without
// an image.
double hidden_share(const CoveredFrame& frame);

struct PixelMask {
  PixelRect area;
  std::vector<uint8_t> set;  // by row; empty: no pixel is
};

// `half_hidden`: the frames in which the subject is behind the thing; `whole`: further frames.
// `metres_per_px`: at the subject. An empty mask if nothing larger than a forearm is found.
PixelMask hidden_pixels(std::span<const CoveredFrame> half_hidden,
                        std::span<const CoveredFrame> whole, double metres_per_px);

// From then on the pixels of the mask, whose area contains that of the planes, contain no evidence.
void hide(const PixelMask& mask, LogRatioPlanes& planes);

}  // namespace observation
}  // namespace walktrack
