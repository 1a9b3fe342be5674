#include "observation/silhouette/foreground_sums.h"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

namespace walktrack {
namespace {

constexpr PixelRect kSummed{3, 2, 40, 30};

LogRatioPlanes planes_of_two() {
  LogRatioPlanes out;
  resize(out, kSummed, 2);
  std::vector<float> row(static_cast<size_t>(kSummed.width()));
  for (int plane = 0; plane < 2; ++plane) {
    for (int y = kSummed.y0; y < kSummed.y1; ++y) {
      for (size_t x = 0; x < row.size(); ++x)
        row[x] = static_cast<float>((7 * static_cast<int>(x) + 5 * y + 3 * plane) % 11 - 6) / 4;
      set_row(out, plane, y, row, 4);
    }
  }
  out.plane_of.fill(0);
  out.plane_of[1] = 1;
  return out;
}

bool in_box(const PixelRect& box, int x, int y) {
  return box.x0 <= x && x < box.x1 && box.y0 <= y && y < box.y1;
}

// Pixel by pixel.
double summed(const LogRatioPlanes& planes, const PixelRect& box,
              const std::vector<PixelRect>& but) {
  double out = 0;
  for (int y = box.y0; y < box.y1; ++y) {
    for (int x = box.x0; x < box.x1; ++x) {
      if (std::ranges::any_of(but, [&](const PixelRect& b) { return in_box(b, x, y); })) continue;
      out += std::max({0.0, log_ratio_at(planes, Appearance{0}, x, y),
                       log_ratio_at(planes, Appearance{1}, x, y)});
    }
  }
  return out;
}

TEST(ForegroundSums, AreThoseOfThePixelsInTheBox) {
  const LogRatioPlanes planes = planes_of_two();
  const std::vector<PixelRect> but{{10, 5, 20, 12}, {-5, 28, 8, 50}, {60, 0, 70, 9}, {9, 9, 2, 4}};
  const ForegroundSums all(planes, {}), rest(planes, but);
  for (const PixelRect& box :
       {kSummed, PixelRect{5, 4, 17, 29}, PixelRect{-10, -10, 100, 6}, PixelRect{39, 29, 40, 30}}) {
    EXPECT_NEAR(all.within(box), summed(planes, box, {}), 1e-4);
    EXPECT_NEAR(rest.within(box), summed(planes, box, but), 1e-4);
  }
  EXPECT_EQ(all.all(), all.within(kSummed));
  EXPECT_LT(rest.all(), all.all());
}

TEST(ForegroundSums, OutsideOfThePictureThereIsNothing) {
  const LogRatioPlanes planes = planes_of_two();
  const ForegroundSums sums(planes, {});
  EXPECT_EQ(sums.within({50, 0, 60, 20}), 0);
  EXPECT_EQ(sums.within({10, 20, 5, 25}), 0);
  EXPECT_EQ(ForegroundSums({}, {}).all(), 0);
}

}  // namespace
}  // namespace walktrack
