#include "observation/flow/frame_pair.h"

#include <opencv2/imgproc.hpp>

namespace walktrack {
inline namespace observation {

namespace {

// Number of pixels around the area that are kept: a foot swings this far between frames. By hand.
constexpr int kMargin = 48;
// Smoothing, px: less than a limb's width, and enough that a motion that is off by a pixel is
// pulled in the right direction. By hand, like the two below.
constexpr double kGreySmoothing = 0.8;
constexpr float kNoise = 4;    // of a difference without texture, grey levels
constexpr float kErrorPx = 1;  // allowed error of a pose's motion

cv::Mat smoothed(const cv::Mat& grey) {
  cv::Mat out;
  grey.convertTo(out, CV_32F);
  cv::GaussianBlur(out, out, {0, 0}, kGreySmoothing);
  return out;
}

}  // namespace

cv::Mat view_of(const GreyImage& image) {
  return {image.height, image.width, CV_8U, const_cast<uint8_t*>(image.pixels.data())};
}

FramePair pair_frames(const GreyImage& before, const GreyImage& now, const PixelRect& area) {
  FramePair out;
  if (area.empty()) return out;
  out.area =
      intersection({area.x0 - kMargin, area.y0 - kMargin, area.x1 + kMargin, area.y1 + kMargin},
                   {0, 0, now.width, now.height});
  if (out.area.empty()) return {};  // the legs are outside the image
  const cv::Rect cut(out.area.x0, out.area.y0, out.area.width(), out.area.height());
  const cv::Mat present = smoothed(view_of(now)(cut)), past = smoothed(view_of(before)(cut));
  cv::Mat gradient_x, gradient_y;  // grey levels per px
  cv::Sobel(present, gradient_x, CV_32F, 1, 0, 3, 1.0 / 8);
  cv::Sobel(present, gradient_y, CV_32F, 0, 1, 3, 1.0 / 8);
  for (int y = 0; y < cut.height; ++y) {
    for (int x = 0; x < cut.width; ++x) {
      const float gx = gradient_x.at<float>(y, x), gy = gradient_y.at<float>(y, x);
      out.pixels.push_back({present.at<float>(y, x), past.at<float>(y, x),
                            1 / (kNoise * kNoise + kErrorPx * kErrorPx * (gx * gx + gy * gy))});
    }
  }
  return out;
}

}  // namespace observation
}  // namespace walktrack
