#include "observation/figures/moving_figure.h"

#include <algorithm>
#include <cmath>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace walktrack {
inline namespace observation {

namespace {

using Eigen::Vector2d;

// All by hand.
constexpr int kShrunkSide = 640;                                // px, enough to detect a figure
constexpr int kBackgroundFrames = 25;                           // the empty scene is the median of
                                                                // so many frames
constexpr int kDifference = 25;                                 // grey levels
constexpr double kSmallestFigure = 5e-4, kLargestFigure = 0.3;  // shares of the image
constexpr double kUpperPart = 0.4;  // of a figure's height, without shadow and legs

void put_smaller_first(uchar* a, uchar* b, size_t width) {
  for (size_t x = 0; x < width; ++x) {
    const uchar low = std::min(a[x], b[x]), high = std::max(a[x], b[x]);
    a[x] = low;
    b[x] = high;
  }
}

cv::Mat median_frame(const std::vector<cv::Mat>& all) {
  std::vector<const cv::Mat*> frames;
  for (const cv::Mat& frame : all)
    if (!frame.empty()) frames.push_back(&frame);
  if (frames.empty()) return {};
  cv::Mat median = frames.front()->clone();
  const size_t count = std::min<size_t>(kBackgroundFrames, frames.size());
  const auto width = static_cast<size_t>(median.cols);
  std::vector<uchar> rows(count * width);
  for (int y = 0; y < median.rows; ++y) {
    for (size_t k = 0; k < count; ++k)
      std::copy_n(frames[k * frames.size() / count]->ptr<uchar>(y), width, &rows[k * width]);
    // Pixels are stored side by side, so that the comparison can be vectorised.
    for (size_t i = 0; i <= count / 2; ++i)
      for (size_t k = i + 1; k < count; ++k)
        put_smaller_first(&rows[i * width], &rows[k * width], width);
    std::copy_n(&rows[count / 2 * width], width, median.ptr<uchar>(y));
  }
  return median;
}

// The part of the image with motion, with a margin for which closing gaps gives the same result as
// in the whole image.
cv::Rect moving_part(const cv::Mat& moving) {
  constexpr int kAround = 4;  // px, the radius of closing gaps
  const cv::Rect found = cv::boundingRect(moving);
  if (found.empty()) return {};
  const cv::Rect whole({}, moving.size());
  return (found - cv::Point(kAround, kAround) + cv::Size(2 * kAround, 2 * kAround)) & whole;
}

// The largest blob: 255 on it, and its bounding box. Empty for a black image.
struct Blob {
  cv::Mat mask;  // of the image's part `around`
  cv::Rect around;
  int area = 0;
};

Blob largest_blob(const cv::Mat& moving) {
  cv::Mat labels, statistics, centres;
  const int count = cv::connectedComponentsWithStats(moving, labels, statistics, centres);
  int best = 0, area = 0;
  for (int i = 1; i < count; ++i) {
    if (statistics.at<int>(i, cv::CC_STAT_AREA) <= area) continue;
    area = statistics.at<int>(i, cv::CC_STAT_AREA);
    best = i;
  }
  if (area == 0) return {};
  const cv::Rect box(
      statistics.at<int>(best, cv::CC_STAT_LEFT), statistics.at<int>(best, cv::CC_STAT_TOP),
      statistics.at<int>(best, cv::CC_STAT_WIDTH), statistics.at<int>(best, cv::CC_STAT_HEIGHT));
  return {labels(box) == best, box, area};
}

// Adds the blob's outermost pixels in each column, px of the shrunk image.
void add_ends(const Blob& blob, int image_rows, MovingFigure& figure) {
  const cv::Rect& box = blob.around;
  for (int x = 0; x < box.width; ++x) {
    int top = -1, bottom = -1;
    for (int y = 0; y < box.height; ++y) {
      if (blob.mask.at<uchar>(y, x) == 0) continue;
      if (top < 0) top = y;
      bottom = y;
    }
    if (top < 0) continue;
    if (box.y > 0) figure.tops.emplace_back(box.x + x, box.y + top - 0.5);
    if (box.y + box.height < image_rows)
      figure.bottoms.emplace_back(box.x + x, box.y + bottom + 0.5);
  }
}

// The largest moving blob, px of the shrunk image. Its middle is that of the upper part, because
// the lower part may contain a shadow. nullopt if it touches the left or right border of the image.
std::optional<MovingFigure> figure_in(const cv::Mat& frame, const cv::Mat& background) {
  cv::Mat difference;
  cv::absdiff(frame, background, difference);
  const cv::Mat everywhere = difference > kDifference;
  // Detecting blobs takes most of the time, so that it is limited to the part with motion.
  const cv::Rect part = moving_part(everywhere);
  if (part.empty()) return std::nullopt;
  cv::Mat moving;
  cv::morphologyEx(everywhere(part), moving, cv::MORPH_CLOSE, cv::Mat::ones(5, 3, CV_8U));
  Blob blob = largest_blob(moving);
  blob.around += part.tl();
  const double share = blob.area / static_cast<double>(frame.total());
  if (share < kSmallestFigure || share > kLargestFigure) return std::nullopt;
  const cv::Rect& box = blob.around;
  if (box.x < 2 || box.x + box.width > frame.cols - 2) return std::nullopt;
  const int upper = static_cast<int>(std::ceil(kUpperPart * box.height));
  const cv::Moments moments = cv::moments(blob.mask.rowRange(0, upper), true);
  MovingFigure figure{
      {box.x + moments.m10 / moments.m00, box.y + moments.m01 / moments.m00}, {}, {}};
  add_ends(blob, frame.rows, figure);
  return figure;
}

MovingFigure enlarged(MovingFigure figure, int factor) {
  const auto enlarge = [&](Vector2d& pixel) { pixel = (pixel.array() + 0.5) * factor - 0.5; };
  enlarge(figure.middle);
  for (auto* ends : {&figure.tops, &figure.bottoms})
    for (Vector2d& pixel : *ends) enlarge(pixel);
  return figure;
}

}  // namespace

MovingFigures::MovingFigures(int width_px, int height_px)
    // Averages over whole pixels are fast.
    : factor_((std::max(width_px, height_px) + kShrunkSide - 1) / kShrunkSide) {}

void MovingFigures::add(const cv::Mat& frame) {
  frames_.emplace_back();
  if (!frame.empty()) cv::cvtColor(frame, frames_.back(), cv::COLOR_BGR2GRAY);
}

FigurePath MovingFigures::path() const {
  FigurePath path;
  const cv::Mat background = median_frame(frames_);
  for (const cv::Mat& frame : frames_) {
    path.emplace_back();
    if (frame.empty()) continue;
    const auto figure = figure_in(frame, background);
    if (figure) path.back() = enlarged(*figure, factor_);
  }
  return path;
}

}  // namespace observation
}  // namespace walktrack
