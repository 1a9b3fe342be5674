#include "io/ffmpeg/mean_colours.h"

#include <algorithm>
#include <vector>

namespace walktrack {
inline namespace io {

namespace {

using Sums = std::vector<uint16_t>;  // of columns

// sums += times * row. The compiler makes vectors of it.
void add_row(const uint8_t* __restrict row, uint16_t times, uint16_t* __restrict sums,
             size_t count) {
  for (size_t i = 0; i < count; ++i) sums[i] = static_cast<uint16_t>(sums[i] + times * row[i]);
}

// Sums of Y over rows y0 <= y < y1, for columns from x0 on.
void sum_luma(const ColourPlanes& planes, int x0, int y0, int y1, Sums& sums) {
  std::fill(sums.begin(), sums.end(), uint16_t{0});
  for (int y = y0; y < y1; ++y)
    add_row(planes.first[0] + static_cast<ptrdiff_t>(y) * planes.stride[0] + x0, 1, sums.data(),
            sums.size());
}

// Sums of U (1) or V (2) over the same rows of pixels: two of them share a row of the plane.
void sum_chroma(const ColourPlanes& planes, size_t plane, int x0, int y0, int y1, Sums& sums) {
  std::fill(sums.begin(), sums.end(), uint16_t{0});
  for (int y = y0; y < y1;) {
    const int times = y % 2 == 0 && y + 1 < y1 ? 2 : 1;
    add_row(planes.first[plane] + static_cast<ptrdiff_t>(y / 2) * planes.stride[plane] + x0 / 2,
            static_cast<uint16_t>(times), sums.data(), sums.size());
    y += times;
  }
}

int luma_between(const Sums& sums, int begin, int end) {
  int sum = 0;
  for (int x = begin; x < end; ++x) sum += sums[static_cast<size_t>(x)];
  return sum;
}

// Over pixels begin <= x < end; pixel x has the sum x / 2 - first.
int chroma_between(const Sums& sums, int first, int begin, int end) {
  int sum = 0;
  for (int x = begin; x < end;) {
    const int times = x % 2 == 0 && x + 1 < end ? 2 : 1;
    sum += times * sums[static_cast<size_t>(x / 2 - first)];
    x += times;
  }
  return sum;
}

uint8_t level(float value) { return cv::saturate_cast<uint8_t>(value); }

// ITU-R BT.601.
struct Conversion {
  explicit Conversion(bool full_range)
      : gain(full_range ? 1.F : 255.F / 219), chroma(full_range ? 1.F : 255.F / 224) {
    black = full_range ? 0.F : 16.F;
  }
  cv::Vec3b bgr(float luma, float u, float v) const {
    const float y = gain * (luma - black), cb = chroma * (u - 128), cr = chroma * (v - 128);
    return {level(y + 1.772F * cb), level(y - 0.344136F * cb - 0.714136F * cr),
            level(y + 1.402F * cr)};
  }
  float gain, chroma, black;
};

}  // namespace

void mean_colours(const ColourPlanes& planes, const cv::Rect& area, int shrink, cv::Mat& bgr) {
  const int width = area.width / shrink, height = area.height / shrink;
  bgr.create(height, width, CV_8UC3);
  const int x0 = area.x, x1 = x0 + width * shrink;
  Sums luma(static_cast<size_t>(x1 - x0));
  Sums u(static_cast<size_t>((x1 + 1) / 2 - x0 / 2)), v(u.size());
  const Conversion conversion(planes.full_range);
  const float scale = 1.F / static_cast<float>(shrink * shrink);
  const auto mean = [&](int sum) { return scale * static_cast<float>(sum); };
  for (int row = 0; row < height; ++row) {
    const int y0 = area.y + row * shrink, y1 = y0 + shrink;
    sum_luma(planes, x0, y0, y1, luma);
    sum_chroma(planes, 1, x0, y0, y1, u);
    sum_chroma(planes, 2, x0, y0, y1, v);
    for (int column = 0; column < width; ++column) {
      const int begin = x0 + column * shrink, end = begin + shrink;
      bgr.at<cv::Vec3b>(row, column) = conversion.bgr(
          mean(luma_between(luma, begin - x0, end - x0)),
          mean(chroma_between(u, x0 / 2, begin, end)), mean(chroma_between(v, x0 / 2, begin, end)));
    }
  }
}

}  // namespace io
}  // namespace walktrack
