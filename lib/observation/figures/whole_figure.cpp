#include "observation/figures/whole_figure.h"

#include <algorithm>
#include <utility>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace walktrack {
inline namespace observation {

namespace {

// All by hand, on videos of people who walk past.
constexpr double kLeastHeight = 0.08, kMostHeight = 0.98;  // of the figure, shares of the image
constexpr double kWidest = 1.2;                            // a walking person is higher than wide
// Margins above the points of the head and below those of the ankles, shares of their distance.
constexpr double kAboveHead = 0.17, kBelowAnkle = 0.10, kBeside = 0.2;
// Shares of the height of a detected person: the height of pieces that are more than noise, and the
// height that a complete person covers.
constexpr double kLeastPiece = 0.04, kLeastCovered = 0.72;
constexpr float kSurePoint = 0.25F;  // least confidence of a point

// Any camera will do: only the size of its images matters here.
Camera plain_camera(int width_px, int height_px) {
  Camera camera;
  camera.width_px = width_px;
  camera.height_px = height_px;
  camera.focal_px = {1.0 * width_px, 1.0 * width_px};
  camera.centre_px = {0.5 * width_px, 0.5 * height_px};
  return camera;
}

ObservationConfig background_alone() {
  ObservationConfig out;
  out.foreground.enabled = false;
  out.flow.enabled = TermSetting::kOff;
  out.keypoints.enabled = TermSetting::kOff;
  return out;
}

ObserverInput observer_input(int width_px, int height_px, BackgroundModel background, int shrink,
                             int threads) {
  ObserverInput out;
  out.camera = plain_camera(width_px, height_px);
  out.shrink = shrink;
  out.appearances[static_cast<size_t>(Appearance::kTrunk)] = true;
  out.background = std::move(background);
  out.threads = threads;
  return out;
}

// A connected part of the foreground, px of the shrunk image.
struct Part {
  cv::Rect box;
  cv::Mat mask;  // of the box
};

// The parts that are at least this high.
std::vector<Part> parts_of(const cv::Mat& mask, double least_px) {
  cv::Mat labels, statistics, centres;
  const int count = cv::connectedComponentsWithStats(mask, labels, statistics, centres);
  std::vector<Part> parts;
  for (int i = 1; i < count; ++i) {
    const auto at = [&](int column) { return statistics.at<int>(i, column); };
    const cv::Rect box(at(cv::CC_STAT_LEFT), at(cv::CC_STAT_TOP), at(cv::CC_STAT_WIDTH),
                       at(cv::CC_STAT_HEIGHT));
    if (box.height >= least_px) parts.push_back({box, labels(box) == i});
  }
  return parts;
}

// The box that can contain a detected person, px of the image; nullopt without head and ankles.
std::optional<cv::Rect> box_of(const DetectedPerson& person) {
  using enum KeypointName;
  double top = 1e9, bottom = -1e9, left = 1e9, right = -1e9;
  int head = 0, ankles = 0;
  for (size_t i = 0; i < kKeypointCount; ++i) {
    const auto name = static_cast<KeypointName>(i);
    const Keypoint& point = person[name];
    if (point.confidence < kSurePoint) continue;
    if (name <= kRightEar) {
      top = std::min<double>(top, point.y_px);
      ++head;
    }
    if (name == kLeftAnkle || name == kRightAnkle) {
      bottom = std::max<double>(bottom, point.y_px);
      ++ankles;
    }
    left = std::min<double>(left, point.x_px);
    right = std::max<double>(right, point.x_px);
  }
  const double height = bottom - top;
  if (head == 0 || ankles == 0 || height <= 0) return std::nullopt;
  return cv::Rect(cv::Point2d(left - kBeside * height, top - kAboveHead * height),
                  cv::Point2d(right + kBeside * height, bottom + kBelowAnkle * height));
}

// The first and last row in which the figure is wider than noise.
std::optional<WholeFigure> ends_of(const cv::Mat& part, const cv::Rect& box, int shrink) {
  const int least = std::max(1, box.height / 80);
  int top = -1, bottom = -1;
  for (int y = 0; y < part.rows; ++y) {
    if (cv::countNonZero(part.row(y)) < least) continue;
    if (top < 0) top = y;
    bottom = y;
  }
  if (top < 0) return std::nullopt;
  const cv::Moments moments = cv::moments(part.rowRange(top, (top + bottom) / 2 + 1), true);
  // Edges are between pixels.
  const auto enlarged = [&](double edge) { return shrink * edge - 0.5; };
  return WholeFigure{enlarged(box.x + moments.m10 / moments.m00 + 0.5), enlarged(box.y + top),
                     enlarged(box.y + bottom + 1)};
}

// The figure of a box of a mask; nullopt if it cannot be a complete person.
std::optional<WholeFigure> figure_of(const cv::Mat& part, const cv::Rect& box,
                                     const cv::Size& image, int shrink) {
  if (box.height < kLeastHeight * image.height || box.height > kMostHeight * image.height ||
      box.width > kWidest * box.height)
    return std::nullopt;
  if (box.x <= 1 || box.y <= 1 || box.x + box.width >= image.width - 1 ||
      box.y + box.height >= image.height - 1)
    return std::nullopt;  // cut off by the border of the image
  return ends_of(part, box, shrink);
}

// All foreground where the network detects a person, because a figure may be in pieces.
std::optional<WholeFigure> figure_in(const cv::Mat& mask, const cv::Rect& person, int shrink) {
  const cv::Rect around = cv::Rect(person.x / shrink, person.y / shrink, person.width / shrink,
                                   person.height / shrink) &
                          cv::Rect({}, mask.size());
  if (around.empty()) return std::nullopt;
  cv::Mat whole = cv::Mat::zeros(around.size(), CV_8U);
  for (const Part& part : parts_of(mask(around), kLeastPiece * around.height))
    whole(part.box).setTo(255, part.mask);
  const cv::Rect box = cv::boundingRect(whole);
  // A person's points cover nine tenths of their height; less foreground is not the person, or is
  // partly hidden.
  if (box.height < kLeastCovered * around.height) return std::nullopt;
  return figure_of(whole(box), box + around.tl(), mask.size(), shrink);
}

}  // namespace

ForegroundMask::ForegroundMask(int width_px, int height_px, BackgroundModel background, int shrink,
                               int threads)
    : observer_(background_alone(),
                observer_input(width_px, height_px, std::move(background), shrink, threads)) {}

cv::Mat ForegroundMask::of(const cv::Mat& frame) {
  observer_.observe(frame, whole_image(observer_.camera(), 0.01), evidence_);
  const LogRatioPlanes& planes = evidence_.planes;
  cv::Mat mask(observer_.camera().height_px, observer_.camera().width_px, CV_8U);
  for (int y = 0; y < mask.rows; ++y)
    for (int x = 0; x < mask.cols; ++x)
      mask.at<uchar>(y, x) = log_ratio_at(planes, Appearance::kTrunk, x, y) > 0 ? 255 : 0;
  cv::morphologyEx(mask, mask, cv::MORPH_OPEN, cv::Mat::ones(2, 2, CV_8U));
  cv::morphologyEx(mask, mask, cv::MORPH_CLOSE, cv::Mat::ones(7, 3, CV_8U));
  return mask;
}

std::vector<WholeFigure> whole_figures(const cv::Mat& mask, int shrink) {
  std::vector<WholeFigure> out;
  for (const Part& part : parts_of(mask, kLeastHeight * mask.rows))
    if (const auto figure = figure_of(part.mask, part.box, mask.size(), shrink))
      out.push_back(*figure);
  return out;
}

std::optional<WholeFigure> whole_figure_of(const DetectedPerson& person, const cv::Mat& mask,
                                           int shrink) {
  const auto box = box_of(person);
  return box ? figure_in(mask, *box, shrink) : std::nullopt;
}

}  // namespace observation
}  // namespace walktrack
