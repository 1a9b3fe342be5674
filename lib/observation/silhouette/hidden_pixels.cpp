#include "observation/silhouette/hidden_pixels.h"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "observation/silhouette/silhouette.h"

namespace walktrack {
inline namespace observation {

namespace {

// By hand (lib/tracker/reports/search.md). kSure: nats against a pixel that shows the subject
// whenever they are there. kCertain: share of the radii within which a figure covers the subject.
// kBeyond: how far a thing extends beyond the pixels that are sure, m. kForeground: nats above
// which the mean of kTogether x kTogether pixels looks like a foreground: sums of fixed-point
// numbers, exact. kSmallest: area of the sure pixels of a thing, m^2.
constexpr float kSure = 2.5;
constexpr double kCertain = 0.75;
constexpr double kBeyond = 0.4;
constexpr double kForeground = 1;
constexpr int kTogether = 5;
constexpr double kSmallest = 0.01;

int reach_px(double metres, double metres_per_px) {
  return std::max(1, static_cast<int>(std::lround(metres / metres_per_px)));
}

cv::Mat ratio_image(const LogRatioPlanes& planes) {
  const PixelRect& area = planes.area;
  cv::Mat out(area.height(), area.width(), CV_32F);
  for (int y = 0; y < out.rows; ++y)
    best_ratios(planes, area.y0 + y, {out.ptr<float>(y), static_cast<size_t>(out.cols)});
  return out;
}

// The probability that the subject covers each pixel.
cv::Mat coverage_image(const PixelRect& area, std::span<const CapsuleList> figures) {
  cv::Mat out = cv::Mat::zeros(area.height(), area.width(), CV_32F);
  const auto share = static_cast<float>(1.0 / static_cast<double>(figures.size()));
  for (const CapsuleList& figure : figures)
    for (const VisibleRun& run : visible_runs(area, scaled_radii(figure, kCertain))) {
      float* const row = out.ptr<float>(run.y - area.y0);
      for (int x = run.x0; x < run.x1; ++x) row[x - area.x0] += share;
    }
  return out;
}

struct PixelSums {
  PixelRect area;
  cv::Mat visible;     // nats for nothing being in front of the subject
  cv::Mat foreground;  // 255 where a pixel has once looked like a foreground
};

// The smallest area that contains those of all frames with an image.
PixelRect area_of(std::span<const CoveredFrame> half_hidden, std::span<const CoveredFrame> whole) {
  cv::Rect area;
  for (const std::span<const CoveredFrame> frames : {half_hidden, whole}) {
    for (const CoveredFrame& frame : frames) {
      const PixelRect& own = frame.planes->area;
      if (frame.planes->count > 0) area |= cv::Rect(own.x0, own.y0, own.width(), own.height());
    }
  }
  return {area.x, area.y, area.br().x, area.br().y};
}

void add_frame(const CoveredFrame& frame, PixelSums& sums) {
  if (frame.planes->count == 0) return;  // no image
  const PixelRect& part = frame.planes->area;
  const cv::Rect there(part.x0 - sums.area.x0, part.y0 - sums.area.y0, part.width(), part.height());
  const cv::Mat ratios = ratio_image(*frame.planes),
                cover = coverage_image(frame.planes->area, frame.figures);
  for (int y = 0; y < ratios.rows; ++y) {
    const float *l = ratios.ptr<float>(y), *c = cover.ptr<float>(y);
    float* const sum = sums.visible.ptr<float>(there.y + y) + there.x;
    for (int x = 0; x < ratios.cols; ++x)
      if (c[x] > 0) sum[x] += std::log1p(c[x] * std::expm1(l[x]));
  }
  cv::Mat together;
  cv::blur(ratios, together, {kTogether, kTogether});
  cv::Mat seen = sums.foreground(there);
  seen |= together > kForeground;
}

// Of the pixels inside a figure, those that look like the empty scene.
double empty_share(const LogRatioPlanes& planes, const CapsuleList& figure) {
  int64_t covered = 0, empty = 0;
  for (const VisibleRun& run : visible_runs(planes.area, figure)) {
    const Appearance appearance = figure[static_cast<size_t>(run.capsule)].appearance;
    const std::span<const int32_t> row =
        planes.row(planes.plane_of[static_cast<size_t>(appearance)], run.y);
    covered += run.x1 - run.x0;
    for (int x = run.x0 - planes.area.x0; x < run.x1 - planes.area.x0; ++x)
      empty += row[static_cast<size_t>(x) + 1] < row[static_cast<size_t>(x)];
  }
  return covered > 0 ? double(empty) / double(covered) : 0;
}

}  // namespace

double hidden_share(const CoveredFrame& frame) {
  if (frame.planes->count == 0 || frame.figures.empty()) return 0;
  double sum = 0;
  for (const CapsuleList& figure : frame.figures)
    sum += empty_share(*frame.planes, scaled_radii(figure, kCertain));
  return sum / static_cast<double>(frame.figures.size());
}

PixelMask hidden_pixels(std::span<const CoveredFrame> half_hidden,
                        std::span<const CoveredFrame> whole, double metres_per_px) {
  const PixelRect area = area_of(half_hidden, whole);
  if (area.empty()) return {};  // no image
  PixelSums sums{area, cv::Mat::zeros(area.height(), area.width(), CV_32F),
                 cv::Mat::zeros(area.height(), area.width(), CV_8U)};
  for (const CoveredFrame& frame : half_hidden) add_frame(frame, sums);
  const cv::Mat hidden = sums.visible < -kSure;
  for (const CoveredFrame& frame : whole) add_frame(frame, sums);
  cv::Mat sure = hidden & (sums.visible < -kSure) & ~sums.foreground;
  cv::morphologyEx(sure, sure, cv::MORPH_OPEN, cv::Mat::ones(3, 3, CV_8U));
  if (cv::countNonZero(sure) * metres_per_px * metres_per_px < kSmallest) return {};
  const int reach = 2 * reach_px(kBeyond, metres_per_px) + 1;
  cv::dilate(sure, sure, cv::Mat::ones(reach, reach, CV_8U));
  sure &= ~sums.foreground;
  return {area, {sure.begin<uint8_t>(), sure.end<uint8_t>()}};
}

void hide(const PixelMask& mask, LogRatioPlanes& planes) {
  if (mask.set.empty() || planes.count == 0) return;
  const auto width = static_cast<size_t>(planes.area.width());
  const auto row_of_mask = static_cast<size_t>(mask.area.width());
  const auto left = static_cast<size_t>(planes.area.x0 - mask.area.x0);
  for (int y = planes.area.y0; y < planes.area.y1; ++y) {
    const uint8_t* const set =
        mask.set.data() + row_of_mask * static_cast<size_t>(y - mask.area.y0) + left;
    for (int plane = 0; plane < planes.count; ++plane) {
      const std::span<int32_t> row = planes.row(plane, y);
      int32_t before = row[0], sum = row[0];
      for (size_t x = 0; x < width; ++x) {
        const int32_t now = row[x + 1];
        if (!set[x]) sum += now - before;
        before = now;
        row[x + 1] = sum;
      }
    }
  }
}

}  // namespace observation
}  // namespace walktrack
