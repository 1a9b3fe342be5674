// Whether the cameras of a scene are in step, from what moves in their images.
#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <Eigen/LU>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "io/video/video.h"
#include "jobs/check/check_parts.h"

namespace walktrack {

namespace {

using Eigen::Vector2d;

constexpr int kShrunkSide = 320;                                // px, enough to find a figure
constexpr int kBackgroundFrames = 25;                           // whose median is the empty scene
constexpr int kDifference = 25;                                 // grey levels
constexpr double kSmallestFigure = 5e-4, kLargestFigure = 0.3;  // shares of the image
constexpr double kUpperPart = 0.4;  // of a figure's height, free of shadow and legs
constexpr int kLargestLag = 15;     // frames
constexpr int kFewestInstants = 20;
// One camera is said to be late when the planes miss each other by more than shadows and arms make
// them (m), and the lag brings them this much nearer.
constexpr double kClearGap = 0.012, kClearGain = 0.6;
constexpr double kParallel = 0.03;  // smallest determinant of the planes' normals that still meet

std::vector<cv::Mat> shrunk_frames(const SceneCamera& camera, double& scale) {
  FrameSource source(camera.video, cv::Size(camera.camera.width_px, camera.camera.height_px));
  std::vector<cv::Mat> frames;
  if (!source.skip(camera.start_frame)) return frames;
  scale = std::min(1.0,
                   double(kShrunkSide) / std::max(camera.camera.width_px, camera.camera.height_px));
  cv::Mat frame, small;
  while (static_cast<int>(frames.size()) < kMostSyncFrames && source.read(frame)) {
    cv::resize(frame, small, {}, scale, scale, cv::INTER_AREA);
    cv::cvtColor(small, frames.emplace_back(), cv::COLOR_BGR2GRAY);
  }
  return frames;
}

cv::Mat median_frame(const std::vector<cv::Mat>& frames) {
  cv::Mat median = frames.front().clone();
  const size_t count = std::min<size_t>(kBackgroundFrames, frames.size());
  std::vector<uchar> values(count);
  for (int y = 0; y < median.rows; ++y) {
    for (int x = 0; x < median.cols; ++x) {
      for (size_t k = 0; k < count; ++k)
        values[k] = frames[k * frames.size() / count].at<uchar>(y, x);
      std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(count / 2), values.end());
      median.at<uchar>(y, x) = values[count / 2];
    }
  }
  return median;
}

// Centre of the upper part of the largest moving blob (its shadow lies below), px of the shrunk
// image; none if it touches the image's side.
std::optional<Vector2d> figure_in(const cv::Mat& frame, const cv::Mat& background) {
  cv::Mat difference, labels, statistics, centres;
  cv::absdiff(frame, background, difference);
  cv::Mat moving = difference > kDifference;
  cv::morphologyEx(moving, moving, cv::MORPH_CLOSE, cv::Mat::ones(5, 3, CV_8U));
  const int count = cv::connectedComponentsWithStats(moving, labels, statistics, centres);
  int best = 0, area = 0;
  for (int i = 1; i < count; ++i) {
    if (statistics.at<int>(i, cv::CC_STAT_AREA) <= area) continue;
    area = statistics.at<int>(i, cv::CC_STAT_AREA);
    best = i;
  }
  const double share = area / static_cast<double>(frame.total());
  if (share < kSmallestFigure || share > kLargestFigure) return std::nullopt;
  const cv::Rect box(
      statistics.at<int>(best, cv::CC_STAT_LEFT), statistics.at<int>(best, cv::CC_STAT_TOP),
      statistics.at<int>(best, cv::CC_STAT_WIDTH),
      static_cast<int>(std::ceil(kUpperPart * statistics.at<int>(best, cv::CC_STAT_HEIGHT))));
  if (box.x < 2 || box.x + box.width > frame.cols - 2) return std::nullopt;
  const cv::Moments moments = cv::moments(labels(box) == best, true);
  return Vector2d(box.x + moments.m10 / moments.m00, box.y + moments.m01 / moments.m00);
}

// The vertical plane through a camera and the figure: normal . x = offset on the ground.
struct Plane {
  Vector2d normal;  // unit
  double offset;
};

using PlanePath = std::vector<std::optional<Plane>>;

PlanePath planes_of(const Camera& camera, const FigurePath& path) {
  PlanePath planes;
  for (const auto& pixel : path) {
    planes.emplace_back();
    const auto ray = pixel ? unproject(camera, *pixel) : std::nullopt;
    if (!ray || ray->direction.head<2>().norm() < 1e-3) continue;
    const Vector2d along = ray->direction.head<2>().normalized();
    const Vector2d normal(-along.y(), along.x());
    planes.back() = Plane{normal, normal.dot(ray->origin.head<2>())};
  }
  return planes;
}

// Root mean square distance, m, of the planes of one instant from the line nearest to them all.
std::optional<double> gap_at(const std::vector<PlanePath>& planes, int instant, size_t late,
                             int lag) {
  Eigen::Matrix2d normals = Eigen::Matrix2d::Zero();
  Vector2d right = Vector2d::Zero();
  std::vector<Plane> met;
  for (size_t i = 0; i < planes.size(); ++i) {
    const int at = instant + (i == late ? lag : 0);
    if (at < 0 || at >= static_cast<int>(planes[i].size())) return std::nullopt;
    const auto& plane = planes[i][static_cast<size_t>(at)];
    if (!plane) continue;
    normals += plane->normal * plane->normal.transpose();
    right += plane->offset * plane->normal;
    met.push_back(*plane);
  }
  if (met.size() < 3 || normals.determinant() < kParallel) return std::nullopt;
  const Vector2d meeting = normals.inverse() * right;
  double sum = 0;
  for (const Plane& plane : met) {
    const double distance = plane.normal.dot(meeting) - plane.offset;
    sum += distance * distance;
  }
  return std::sqrt(sum / static_cast<double>(met.size()));
}

// The median over all instants; nullopt if there are too few.
std::optional<double> median_gap(const std::vector<PlanePath>& planes, size_t late, int lag) {
  std::vector<double> gaps;
  for (int instant = 0; instant < kMostSyncFrames; ++instant) {
    if (const auto gap = gap_at(planes, instant, late, lag)) gaps.push_back(*gap);
  }
  if (gaps.size() < kFewestInstants) return std::nullopt;
  const auto middle = gaps.begin() + std::ptrdiff_t(gaps.size() / 2);
  std::nth_element(gaps.begin(), middle, gaps.end());
  return *middle;
}

}  // namespace

FigurePath figure_path(const SceneCamera& camera) {
  if (camera.video.empty()) return {};
  double scale = 1;
  const std::vector<cv::Mat> frames = shrunk_frames(camera, scale);
  FigurePath path;
  if (frames.empty()) return path;
  const cv::Mat background = median_frame(frames);
  for (const cv::Mat& frame : frames) {
    auto place = figure_in(frame, background);
    if (place) place = (place->array() + 0.5) / scale - 0.5;
    path.push_back(place);
  }
  return path;
}

std::vector<OutOfStep> find_out_of_step(const std::vector<Camera>& cameras,
                                        const std::vector<FigurePath>& paths) {
  std::vector<PlanePath> planes;
  for (size_t i = 0; i < cameras.size(); ++i) planes.push_back(planes_of(cameras[i], paths[i]));
  const auto before = median_gap(planes, 0, 0);
  if (!before || *before < kClearGap) return {};
  std::vector<OutOfStep> found;
  for (size_t camera = 0; camera < planes.size(); ++camera) {
    OutOfStep best{camera, 0, *before, *before};
    for (int lag = -kLargestLag; lag <= kLargestLag; ++lag) {
      const auto gap = median_gap(planes, camera, lag);
      if (gap && *gap < best.gap_after) best = {camera, lag, *before, *gap};
    }
    if (best.gap_after < kClearGain * *before) found.push_back(best);
  }
  std::sort(found.begin(), found.end(),
            [](const OutOfStep& a, const OutOfStep& b) { return a.gap_after < b.gap_after; });
  return found;
}

void check_steps(const Scene& scene, const JobControl& control, CheckReport& report) {
  if (scene.cameras.size() < 2) return;
  const auto same_rate = [&](const SceneCamera& camera) {
    return !camera.frame_rate || camera.frame_rate == scene.frame_rate;
  };
  if (scene.cameras.size() == 2 ||
      !std::all_of(scene.cameras.begin(), scene.cameras.end(), same_rate)) {
    report.findings.push_back({"", false, "whether the cameras are in step is not checked",
                               "it takes three cameras of one frame rate"});
    return;
  }
  std::vector<Camera> cameras;
  std::vector<FigurePath> paths;
  for (const SceneCamera& camera : scene.cameras) {
    if (control.stopping()) return;
    control.progress("checking steps", paths.size(), scene.cameras.size());
    cameras.push_back(camera.camera);
    paths.push_back(figure_path(camera));
  }
  const std::vector<OutOfStep> found = find_out_of_step(cameras, paths);
  if (found.empty()) return;
  std::string cure;
  for (const OutOfStep& late : found) {
    const SceneCamera& camera = scene.cameras[late.camera];
    cure += fmt::format("{}start_frame: {} for {} ({:.0f} mm then)", cure.empty() ? "" : ", or ",
                        camera.start_frame + late.frames_late, camera.name, 1000 * late.gap_after);
  }
  report.findings.push_back(
      {"", true,
       fmt::format("the cameras are out of step: planes through the figure miss each other by "
                   "{:.0f} mm",
                   1000 * found.front().gap_before),
       cure + "; a negative number means to raise that of all others instead"});
}

}  // namespace walktrack
