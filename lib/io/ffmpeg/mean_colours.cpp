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

// Sums of the first 0, 1, 2, ... columns.
using Prefix = std::vector<uint32_t>;

void add_up(const Sums& sums, Prefix& prefix) {
  prefix.resize(sums.size() + 1);
  uint32_t sum = 0;
  for (size_t i = 0; i < sums.size(); ++i) prefix[i + 1] = sum += sums[i];
}

// Sums over pixels begin <= x < end, counted from the first column.
uint32_t luma_between(const Prefix& prefix, size_t begin, size_t end) {
  return prefix[end] - prefix[begin];
}

// The same for a plane of colours, two pixels of which share a column. The first column may begin
// with its second pixel: then `begin` and `end` count from its first one.
uint32_t chroma_between(const Prefix& prefix, size_t begin, size_t end) {
  const auto before = [&](size_t x) { return prefix[x / 2] + prefix[(x + 1) / 2]; };
  return before(end) - before(begin);
}

// Means of a row of blocks.
struct Row {
  explicit Row(size_t width) : luma(width), u(width), v(width) {}
  std::vector<float> luma, u, v;
};

// ITU-R BT.601. In loops that the compiler makes vectors of.
class Conversion {
 public:
  Conversion(bool full_range, size_t width)
      : gain_(full_range ? 1.F : 255.F / 219),
        black_(full_range ? 0.F : 16.F),
        chroma_(full_range ? 1.F : 255.F / 224),
        blue_(width),
        green_(width),
        red_(width) {}

  void write(const Row& row, cv::Vec3b* out) {
    const size_t width = row.luma.size();
    constexpr float kHalf = 0.5F;
    const auto level = [](float value) {  // rounded
      return static_cast<int>(std::min(255.F, std::max(0.F, value)) + kHalf);
    };
    for (size_t i = 0; i < width; ++i) {
      const float y = gain_ * (row.luma[i] - black_);
      const float cb = chroma_ * (row.u[i] - 128), cr = chroma_ * (row.v[i] - 128);
      blue_[i] = level(y + 1.772F * cb);
      green_[i] = level(y - 0.344136F * cb - 0.714136F * cr);
      red_[i] = level(y + 1.402F * cr);
    }
    for (size_t i = 0; i < width; ++i)
      out[i] = {static_cast<uint8_t>(blue_[i]), static_cast<uint8_t>(green_[i]),
                static_cast<uint8_t>(red_[i])};
  }

 private:
  float gain_, black_, chroma_;
  std::vector<int> blue_, green_, red_;
};

}  // namespace

void mean_colours(const ColourPlanes& planes, const cv::Rect& area, int shrink, cv::Mat& bgr) {
  const int width = area.width / shrink, height = area.height / shrink;
  bgr.create(height, width, CV_8UC3);
  const int x0 = area.x, x1 = x0 + width * shrink;
  Sums luma(static_cast<size_t>(x1 - x0));
  Sums u(static_cast<size_t>((x1 + 1) / 2 - x0 / 2)), v(u.size());
  Prefix luma_prefix, u_prefix, v_prefix;
  Row means(static_cast<size_t>(width));
  Conversion conversion(planes.full_range, means.luma.size());
  const float scale = 1.F / static_cast<float>(shrink * shrink);
  const auto step = static_cast<size_t>(shrink), odd = static_cast<size_t>(x0 % 2);
  for (int row = 0; row < height; ++row) {
    const int y0 = area.y + row * shrink, y1 = y0 + shrink;
    sum_luma(planes, x0, y0, y1, luma);
    sum_chroma(planes, 1, x0, y0, y1, u);
    sum_chroma(planes, 2, x0, y0, y1, v);
    add_up(luma, luma_prefix);
    add_up(u, u_prefix);
    add_up(v, v_prefix);
    for (size_t i = 0; i < means.luma.size(); ++i) {
      const size_t begin = i * step, end = begin + step;
      means.luma[i] = scale * static_cast<float>(luma_between(luma_prefix, begin, end));
      means.u[i] = scale * static_cast<float>(chroma_between(u_prefix, begin + odd, end + odd));
      means.v[i] = scale * static_cast<float>(chroma_between(v_prefix, begin + odd, end + odd));
    }
    conversion.write(means, bgr.ptr<cv::Vec3b>(row));
  }
}

}  // namespace io
}  // namespace walktrack
