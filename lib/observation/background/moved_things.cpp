#include "observation/background/moved_things.h"

#include <algorithm>
#include <cmath>
#include <span>

#include <opencv2/imgproc.hpp>

#include "core/median.h"
#include "core/parallel_for.h"

namespace walktrack {
inline namespace observation {

namespace {

// By hand. Fewest frames that are compared; the share of them that is nearly all; within how many
// pixels around a thing, and in which share of them and of the frames at most, the video differs as
// well; how far the edge of a thing reaches beyond what is sure, px.
constexpr int kFewestCompared = 4;
constexpr double kNearlyAlways = 0.75;
constexpr int kAround = 2;
constexpr double kMostAround = 0.2;
constexpr int kThingEdge = 2;

const auto kLogAnyColour = static_cast<float>(-3 * std::log(256.0));

cv::Mat square(int side) { return cv::Mat::ones(side, side, CV_8U); }

// Without what is narrower than three pixels.
cv::Mat opened(const cv::Mat& mask) {
  cv::Mat out;
  cv::morphologyEx(mask, out, cv::MORPH_OPEN, square(3));
  return out;
}

// 255 where an arbitrary colour explains the frame better than the model does.
cv::Mat unlike(const BackgroundModel& model, const BackgroundConfig& config, const cv::Mat& bgr,
               int threads) {
  constexpr int kRows = 32;  // of a block
  const cv::Mat picture = changed(bgr, model.change);
  const double gain = light_gain(model, picture);
  cv::Mat out(model.height, model.width, CV_8U);
  parallel_for(static_cast<size_t>((model.height + kRows - 1) / kRows), threads, [&](size_t block) {
    const int first = static_cast<int>(block) * kRows, end = std::min(model.height, first + kRows);
    const PixelRect read{0, std::max(0, first - 1), model.width, std::min(model.height, end + 1)};
    ColourPatch patch;
    read_colours(picture, read, patch);
    std::vector<float> density(static_cast<size_t>(model.width));
    for (int y = first; y < end; ++y) {
      background_log_density(model, config, patch, read, y, gain, density);
      std::ranges::transform(density, out.ptr<uint8_t>(y), [](float log_density) {
        return static_cast<uint8_t>(log_density < kLogAnyColour ? 255 : 0);
      });
    }
  });
  return out;
}

// The connected areas of a mask; label 0 is outside of it.
struct Areas {
  explicit Areas(const cv::Mat& mask) {
    cv::Mat centroids;
    count = static_cast<size_t>(
        cv::connectedComponentsWithStats(mask, labels, stats, centroids, 8, CV_32S));
  }
  double area(size_t label) const {
    return stats.at<int>(static_cast<int>(label), cv::CC_STAT_AREA);
  }
  size_t label(int x, int y) const { return static_cast<size_t>(labels.at<int>(y, x)); }

  cv::Mat labels, stats;
  size_t count = 0;
};

// 255 in the areas that are chosen.
cv::Mat mask_of(const Areas& areas, const std::vector<bool>& chosen) {
  cv::Mat out(areas.labels.size(), CV_8U);
  for (int y = 0; y < out.rows; ++y)
    for (int x = 0; x < out.cols; ++x) out.at<uint8_t>(y, x) = chosen[areas.label(x, y)] ? 255 : 0;
  return out;
}

// The areas of pixels that are unlike the empty scene in nearly all frames, and some of them in
// all: people who pass in front of a thing may have colours of the empty scene.
cv::Mat possible_things(const cv::Mat& always, const cv::Mat& nearly_always, double least_px) {
  const Areas sure(opened(always)), wide(opened(nearly_always));
  std::vector<bool> chosen(wide.count, false);
  for (int y = 0; y < always.rows; ++y) {
    for (int x = 0; x < always.cols; ++x) {
      const size_t core = sure.label(x, y), area = wide.label(x, y);
      if (core > 0 && area > 0 && sure.area(core) >= least_px * least_px) chosen[area] = true;
    }
  }
  return mask_of(wide, chosen);
}

// Those whose surroundings mostly look like the empty scene, with their edges. `unlike_count`: in
// how many of `frames` frames pixels do not.
cv::Mat lasting_things(const cv::Mat& possible, const cv::Mat& unlike_count, int frames) {
  const Areas areas(possible);
  std::vector<bool> lasting(areas.count, false);
  for (size_t k = 1; k < areas.count; ++k) {
    const cv::Mat area = areas.labels == static_cast<int>(k);
    cv::Mat wide, near;
    cv::dilate(area, near, square(3));
    cv::dilate(area, wide, square(2 * kAround + 3));
    lasting[k] = cv::mean(unlike_count, wide & ~near)[0] <= kMostAround * frames;
  }
  cv::Mat out;
  cv::dilate(mask_of(areas, lasting), out, square(2 * kThingEdge + 1));
  return out;
}

// The brightness of the light in a model relative to that in another one.
float relative_light(const BackgroundModel& model, const BackgroundModel& other) {
  std::vector<double> ratios;
  for (const LightPoint& point : light_points(model.width, model.height))
    if (other.luma[point.pixel] > 0)
      ratios.push_back(model.luma[point.pixel] / other.luma[point.pixel]);
  return ratios.empty() ? 1 : static_cast<float>(core::median_of(std::move(ratios)));
}

// Whether the model explains a pixel in most frames, given the masks where it does not.
bool mostly_alike(std::span<const cv::Mat> unlike, int x, int y) {
  const auto alike = std::ranges::count_if(
      unlike, [&](const cv::Mat& mask) { return mask.at<uint8_t>(y, x) == 0; });
  return 2 * static_cast<size_t>(alike) >= unlike.size();
}

}  // namespace

MovedThings::MovedThings(const BackgroundConfig& config, const BackgroundModel& empty_scene,
                         double least_px, int threads)
    : config_(config),
      empty_scene_(empty_scene),
      least_px_(least_px),
      threads_(threads),
      frames_(config) {}

void MovedThings::compare(const cv::Mat& bgr) {
  const cv::Mat ones = unlike(empty_scene_, config_, bgr, threads_) & 1;
  if (compared_++ == 0) {
    ones.convertTo(unlike_count_, CV_32S);
  } else {
    cv::add(unlike_count_, ones, unlike_count_, cv::noArray(), CV_32S);
  }
  frames_.add(bgr);
}

bool MovedThings::possible() const {
  return compared_ == 0 ||
         cv::countNonZero(opened(unlike_count_ == compared_)) >= least_px_ * least_px_;
}

BackgroundModel MovedThings::corrected() const {
  BackgroundModel out = empty_scene_;
  if (compared_ < kFewestCompared || !possible()) return out;
  const cv::Mat possible = possible_things(unlike_count_ == compared_,
                                           unlike_count_ >= kNearlyAlways * compared_, least_px_);
  const cv::Mat things = lasting_things(possible, unlike_count_, compared_);
  if (cv::countNonZero(things) == 0) return out;
  const BackgroundModel seen = frames_.model(threads_);
  std::vector<cv::Mat> unlike_seen;
  for (int f = 0; f < frames_.frames(); ++f)
    unlike_seen.push_back(unlike(seen, config_, frames_.frame(f), threads_));
  const float light = relative_light(seen, out);
  size_t taken = 0, pixel = 0;
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x, ++pixel) {
      if (things.at<uint8_t>(y, x) == 0 || !mostly_alike(unlike_seen, x, y)) continue;
      out.luma[pixel] = seen.luma[pixel] / light;
      out.orange[pixel] = seen.orange[pixel] / light;
      out.green[pixel] = seen.green[pixel] / light;
      out.luma_precision[pixel] = seen.luma_precision[pixel];
      out.chroma_precision[pixel] = seen.chroma_precision[pixel];
      ++taken;
    }
  }
  out.from_video = static_cast<double>(taken) / static_cast<double>(pixel);
  return out;
}

}  // namespace observation
}  // namespace walktrack
