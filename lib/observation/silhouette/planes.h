// Log-ratios of the pixels of one frame, stored so that the sum over a run of pixels in a row takes
// one subtraction.
//
// Values are in fixed point (kNat = 1 nat): integer sums are exact, so that a silhouette's sum does
// not depend on the order of its parts or on threads. Only a rectangle is stored; outside it l = 0,
// i.e. there is no evidence.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "body/body.h"

namespace walktrack {
inline namespace observation {

// Pixels x0 <= x < x1, y0 <= y < y1.
struct PixelRect {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  int width() const { return x1 > x0 ? x1 - x0 : 0; }
  int height() const { return y1 > y0 ? y1 - y0 : 0; }
  bool empty() const { return width() == 0 || height() == 0; }
};

PixelRect intersection(const PixelRect& a, const PixelRect& b);

// One plane for each appearance class, or none at all.
struct LogRatioPlanes {
  static constexpr double kNat = 256;  // fixed-point units in a nat

  PixelRect area;
  int count = 0;                                 // planes
  std::array<int, kAppearanceCount> plane_of{};  // by Appearance
  std::vector<int32_t> prefix;                   // [row][plane][x]: sum over area.x0 .. x - 1

  // The area.width() + 1 prefix sums of one row of one plane.
  std::span<const int32_t> row(int plane, int y) const {
    return {prefix.data() + offset(plane, y), stride()};
  }
  std::span<int32_t> row(int plane, int y) { return {prefix.data() + offset(plane, y), stride()}; }

  size_t stride() const { return static_cast<size_t>(area.width()) + 1; }

 private:
  size_t offset(int plane, int y) const {
    return (static_cast<size_t>(y - area.y0) * static_cast<size_t>(count) +
            static_cast<size_t>(plane)) *
           stride();
  }
};

// Resizes `planes` to `count` planes over `area`, keeping its memory.
void resize(LogRatioPlanes& planes, const PixelRect& area, int count);

// Writes the prefix sums of one row: each value is clipped to +-clip nats.
void set_row(LogRatioPlanes& planes, int plane, int y, std::span<const float> log_ratios,
             double clip);

// The log-ratio of the part that explains each pixel of a row best, nats.
void best_ratios(const LogRatioPlanes& planes, int y, std::span<float> out);

// The log-ratio of one pixel, nats; 0 outside the area.
double log_ratio_at(const LogRatioPlanes& planes, Appearance appearance, int x, int y);

}  // namespace observation
}  // namespace walktrack
