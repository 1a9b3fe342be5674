// Colours as luma and two chromas, by the integer transform of JPEG XR's lossy sibling:
//   Y = (R + 2G + B) / 4,  Co = R - B,  Cg = G - (R + B) / 2
// Its determinant is 1, so that densities over (Y, Co, Cg) are densities over (R, G, B). All three
// are proportional to the brightness of the light.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "observation/silhouette/planes.h"

namespace cv {
class Mat;
}

namespace walktrack {
inline namespace observation {

struct ColourPatch {
  PixelRect area;
  std::vector<float> luma, orange, green;  // area.width() a row; grey levels

  size_t index(int x, int y) const {
    return static_cast<size_t>(y - area.y0) * static_cast<size_t>(area.width()) +
           static_cast<size_t>(x - area.x0);
  }
};

// Converts the pixels of an 8-bit BGR image inside `area`, which must be part of it. Reuses the
// memory of `out`.
void read_colours(const cv::Mat& bgr, const PixelRect& area, ColourPatch& out);

// Bins of colour space: uniform in luma, finer in chroma towards grey, where most colours are.
inline constexpr int kLumaBins = 16, kChromaBins = 33;
inline constexpr int kColourBins = kLumaBins * kChromaBins * kChromaBins;

class ColourBins {
 public:
  ColourBins();
  uint16_t bin(float luma, float orange, float green) const {
    return static_cast<uint16_t>((luma_bin(luma) * kChromaBins + chroma_[chroma_index(orange)]) *
                                     kChromaBins +
                                 chroma_[chroma_index(green)]);
  }
  // Volume of a bin in cubed grey levels, and the middle of its chroma range.
  double volume(int bin) const;
  double middle(int chroma_bin) const { return middle_[static_cast<size_t>(chroma_bin)]; }

 private:
  static int luma_bin(float luma) { return static_cast<int>(luma) / (256 / kLumaBins); }
  static size_t chroma_index(float chroma) {
    return static_cast<size_t>(static_cast<int>(chroma + 256.5F));
  }
  std::array<uint8_t, 513> chroma_;
  std::array<double, kChromaBins> width_, middle_;
};

}  // namespace observation
}  // namespace walktrack
