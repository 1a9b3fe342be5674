#include "observation/background/colour.h"

#include <cmath>

#include <gtest/gtest.h>
#include <Eigen/LU>
#include <opencv2/core.hpp>

namespace walktrack {
namespace {

Eigen::Vector3d converted(const cv::Vec3b& bgr) {
  ColourPatch patch;
  read_colours(cv::Mat(1, 1, CV_8UC3, cv::Scalar(bgr[0], bgr[1], bgr[2])), {0, 0, 1, 1}, patch);
  return Eigen::Vector3f(patch.luma[0], patch.orange[0], patch.green[0]).cast<double>();
}

TEST(Colour, KeepsVolumes) {
  Eigen::Matrix3d columns;
  columns << converted({1, 0, 0}), converted({0, 1, 0}), converted({0, 0, 1});
  EXPECT_NEAR(std::abs(columns.determinant()), 1, 1e-12);
}

TEST(Colour, GreyHasNoChromaAndLightScalesAll) {
  EXPECT_EQ(converted({77, 77, 77}), Eigen::Vector3d(77, 0, 0));
  EXPECT_EQ(converted({40, 80, 120}), 2 * converted({20, 40, 60}));
}

TEST(Colour, ReadsTheAreaOnly) {
  cv::Mat image(4, 5, CV_8UC3, cv::Scalar(0, 0, 0));
  image.at<cv::Vec3b>(2, 3) = {10, 10, 10};
  ColourPatch patch;
  read_colours(image, {3, 1, 5, 3}, patch);
  ASSERT_EQ(patch.luma.size(), 4U);
  EXPECT_EQ(patch.luma[patch.index(3, 2)], 10);
  EXPECT_EQ(patch.luma[patch.index(4, 2)], 0);
}

TEST(ColourBins, FillTheSpaceOfAllColours) {
  const ColourBins bins;
  double volume = 0;
  for (int bin = 0; bin < kColourBins; ++bin) {
    EXPECT_GT(bins.volume(bin), 0);
    volume += bins.volume(bin);
  }
  EXPECT_NEAR(volume, 256.0 * 510 * 510, 1);
}

TEST(ColourBins, EveryColourFallsNearTheMiddleOfItsBin) {
  const ColourBins bins;
  for (int c = -255; c <= 255; c += 3) {
    const int bin = bins.bin(100, static_cast<float>(c), static_cast<float>(-c) / 2);
    EXPECT_EQ(bin / (kChromaBins * kChromaBins), 100 / 16);
    // Bins are at most a quarter as wide as their chroma, or four grey levels.
    EXPECT_NEAR(bins.middle(bin / kChromaBins % kChromaBins), c, 4 + 0.15 * std::abs(c)) << c;
    EXPECT_NEAR(bins.middle(bin % kChromaBins), -c / 2.0, 4 + 0.15 * std::abs(c)) << c;
  }
}

}  // namespace
}  // namespace walktrack
