#include "observation/background/colour.h"

#include <algorithm>
#include <cmath>

#include <opencv2/core.hpp>

namespace walktrack {
inline namespace observation {

void read_colours(const cv::Mat& bgr, const PixelRect& area, ColourPatch& out) {
  out.area = area;
  const size_t size = static_cast<size_t>(area.width()) * static_cast<size_t>(area.height());
  out.luma.resize(size);
  out.orange.resize(size);
  out.green.resize(size);
  size_t i = 0;
  for (int y = area.y0; y < area.y1; ++y) {
    const uint8_t* pixel = bgr.ptr<uint8_t>(y) + 3 * area.x0;
    for (int x = area.x0; x < area.x1; ++x, ++i, pixel += 3) {
      const int b = pixel[0], g = pixel[1], r = pixel[2];
      out.luma[i] = 0.25F * static_cast<float>(r + 2 * g + b);
      out.orange[i] = static_cast<float>(r - b);
      out.green[i] = 0.5F * static_cast<float>(2 * g - r - b);
    }
  }
}

// Chroma c is in bin round(16 asinh(c / 16) / asinh(255 / 16)): 3.5 grey levels wide at grey, about
// 50 at the ends.
ColourBins::ColourBins() {
  constexpr double kBend = 16;  // grey levels; by hand
  constexpr int kHalf = kChromaBins / 2;
  const double scale = kHalf / std::asinh(255 / kBend);
  for (int c = -256; c <= 256; ++c) {
    const double bin = std::round(scale * std::asinh(std::clamp(c, -255, 255) / kBend));
    chroma_[static_cast<size_t>(c + 256)] = static_cast<uint8_t>(kHalf + static_cast<int>(bin));
  }
  for (int bin = 0; bin < kChromaBins; ++bin) {
    const auto edge = [&](double at) { return kBend * std::sinh((at - kHalf) / scale); };
    const double low = std::max(-255.0, edge(bin - 0.5)), high = std::min(255.0, edge(bin + 0.5));
    width_[static_cast<size_t>(bin)] = high - low;
    middle_[static_cast<size_t>(bin)] = 0.5 * (low + high);
  }
}

double ColourBins::volume(int bin) const {
  const auto orange = static_cast<size_t>(bin / kChromaBins % kChromaBins);
  const auto green = static_cast<size_t>(bin % kChromaBins);
  return 256.0 / kLumaBins * width_[orange] * width_[green];
}

}  // namespace observation
}  // namespace walktrack
