#include "observation/background/background_sampler.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <opencv2/core.hpp>

#include "core/errors.h"
#include "core/parallel_for.h"
#include "observation/shrink.h"

namespace walktrack {
inline namespace observation {

namespace {

// Distance from a pixel's densest colour within which its samples are background, grey levels. By
// hand.
constexpr float kNeighbourhood = 18;

// Number of frames in which a pixel has to be free; by hand.
constexpr size_t kFreeFrames = 3;

struct Statistics {
  float luma, orange, green, luma_variance, chroma_variance;
};

struct Sample {
  float luma, orange, green;
};

using Channel = float Sample::*;

// The channel in which samples differ most, relative to equal noise in red, green and blue: people
// differ from the background in lightness, or only in hue.
Channel most_distinctive(const std::vector<Sample>& samples) {
  constexpr std::pair<Channel, float> kChannels[] = {
      {&Sample::luma, 0.612F}, {&Sample::orange, 1.414F}, {&Sample::green, 1.225F}};
  Channel best = &Sample::luma;
  float widest = -1;
  for (const auto& [channel, noise] : kChannels) {
    const auto [low, high] = std::minmax_element(
        samples.begin(), samples.end(),
        [c = channel](const Sample& a, const Sample& b) { return a.*c < b.*c; });
    const float width = ((*high).*channel - (*low).*channel) / noise;
    if (width <= widest) continue;
    widest = width;
    best = channel;
  }
  return best;
}

// The densest part of the samples: the middle of the shortest run of sorted values that contains
// `share` of them (the shorth). It fails only if another colour fills a larger share.
size_t densest_run(const std::vector<Sample>& sorted, Channel channel, size_t length) {
  const auto spread = [&](size_t i) {
    return sorted[i + length - 1].*channel - sorted[i].*channel;
  };
  size_t best = 0;
  for (size_t i = 1; i + length <= sorted.size(); ++i)
    if (spread(i) < spread(best)) best = i;
  return best;
}

float median_of(std::vector<float>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Mean and variances of the samples within reach of the densest colour.
Statistics robust_statistics(std::vector<Sample>& samples, float reach,
                             std::vector<float>& scratch) {
  const Channel telling = most_distinctive(samples);
  std::sort(samples.begin(), samples.end(),
            [=](const Sample& a, const Sample& b) { return a.*telling < b.*telling; });
  const size_t length = (2 * samples.size() + 4) / 5;
  const size_t begin = densest_run(samples, telling, length);
  const auto middle = [&](Channel channel) {
    scratch.clear();
    for (size_t i = begin; i < begin + length; ++i) scratch.push_back(samples[i].*channel);
    return median_of(scratch);
  };
  const Sample mode{middle(&Sample::luma), middle(&Sample::orange), middle(&Sample::green)};
  float n = 0, s[3] = {}, q[3] = {};
  for (const Sample& x : samples) {
    const float d[3] = {x.luma - mode.luma, x.orange - mode.orange, x.green - mode.green};
    if (std::abs(d[0]) > reach || std::abs(d[1]) > reach || std::abs(d[2]) > reach) continue;
    n += 1;
    for (int c = 0; c < 3; ++c) {
      s[c] += d[c];
      q[c] += d[c] * d[c];
    }
  }
  // The medians of the three channels need not be near any sample.
  if (n == 0) return {mode.luma, mode.orange, mode.green, reach * reach, reach * reach};
  const auto variance = [&](int c) { return (q[c] - s[c] * s[c] / n) / std::max(1.F, n - 1); };
  return {mode.luma + s[0] / n, mode.orange + s[1] / n, mode.green + s[2] / n, variance(0),
          0.5F * (variance(1) + variance(2))};
}

void add_range(const cv::Mat& bgr, LumaRange& range) {
  for (const LightPoint& point : light_points(bgr.cols, bgr.rows))
    range.take(luma_at(bgr, point.x, point.y));
}

Sample sample_at(const std::vector<uint8_t>& bgr, size_t pixel, float gain) {
  const float b = bgr[3 * pixel], g = bgr[3 * pixel + 1], r = bgr[3 * pixel + 2];
  return {0.25F * (r + 2 * g + b) / gain, (r - b) / gain, (g - 0.5F * (r + b)) / gain};
}

BackgroundModel sized(int width, int height) {
  BackgroundModel model;
  model.width = width;
  model.height = height;
  const size_t size = static_cast<size_t>(width) * static_cast<size_t>(height);
  for (auto* plane :
       {&model.luma, &model.orange, &model.green, &model.luma_precision, &model.chroma_precision})
    plane->assign(size, 0);
  return model;
}

// The frames that are kept, BGR, and the brightness of each.
struct Frames {
  int width, height;
  const std::vector<std::vector<uint8_t>>& bgr;
  const std::vector<std::vector<uint8_t>>& hidden;
  std::vector<float> gains;
  float reach = kNeighbourhood;  // of a pixel's samples

  bool counts(size_t frame, size_t pixel) const {
    return hidden[frame].empty() || hidden[frame][pixel] == 0;
  }
  bool all_count(size_t pixel) const {
    for (size_t f = 0; f < bgr.size(); ++f)
      if (!counts(f, pixel)) return false;
    return true;
  }

  cv::Mat image(size_t frame) const {
    return {height, width, CV_8UC3, const_cast<uint8_t*>(bgr[frame].data())};
  }
};

// Stores variances in place of precisions, until floor_variances() is called.
void set_pixel(BackgroundModel& model, size_t pixel, const Statistics& s) {
  model.luma[pixel] = s.luma;
  model.orange[pixel] = s.orange;
  model.green[pixel] = s.green;
  model.luma_precision[pixel] = s.luma_variance;
  model.chroma_precision[pixel] = s.chroma_variance;
}

// Estimates single pixels, whatever they show.
class PixelStatistics {
 public:
  explicit PixelStatistics(const Frames& frames) : frames_(frames) {}

  Statistics of(size_t pixel) {
    take(pixel, [&](size_t f) { return frames_.counts(f, pixel); });
    if (samples_.size() >= std::min(kFreeFrames, frames_.bgr.size()))
      return robust_statistics(samples_, frames_.reach, scratch_);
    take(pixel, [](size_t) { return true; });
    Statistics out = robust_statistics(samples_, frames_.reach, scratch_);
    out.luma_variance = out.chroma_variance = 1 / kNeverSeen;
    return out;
  }

 private:
  template <typename Counts>
  void take(size_t pixel, Counts counts) {
    samples_.clear();
    for (size_t f = 0; f < frames_.bgr.size(); ++f)
      if (counts(f)) samples_.push_back(sample_at(frames_.bgr[f], pixel, frames_.gains[f]));
  }

  const Frames& frames_;
  std::vector<Sample> samples_;
  std::vector<float> scratch_;
};

// Sums over the frames for a row of one channel, about the first frame's values.
class ChannelSums {
 public:
  void add(const std::vector<float>& row, float gain, bool first) {
    const size_t width = row.size();
    if (first) {
      for (auto* values : {&low_, &high_, &sum_, &squares_}) values->assign(width, 0);
      origin_.resize(width);
      for (size_t x = 0; x < width; ++x) origin_[x] = row[x] / gain;
      return;
    }
    for (size_t x = 0; x < width; ++x) {
      const float d = row[x] / gain - origin_[x];
      low_[x] = std::min(low_[x], d);
      high_[x] = std::max(high_[x], d);
      sum_[x] += d;
      squares_[x] += d * d;
    }
  }
  float range(size_t x) const { return high_[x] - low_[x]; }
  float mean(size_t x, float n) const { return origin_[x] + sum_[x] / n; }
  float variance(size_t x, float n) const {
    return std::max(0.F, squares_[x] - sum_[x] * sum_[x] / n) / std::max(1.F, n - 1);
  }

 private:
  std::vector<float> origin_, low_, high_, sum_, squares_;
};

// The same for a row of pixels together. If all samples are within reach of each other they are
// within reach of the densest colour, so that no sorting is needed.
void fill_row(const Frames& frames, size_t y, BackgroundModel& model) {
  ColourPatch row;
  ChannelSums luma, orange, green;
  const auto at = static_cast<int>(y);
  for (size_t f = 0; f < frames.bgr.size(); ++f) {
    read_colours(frames.image(f), {0, at, frames.width, at + 1}, row);
    luma.add(row.luma, frames.gains[f], f == 0);
    orange.add(row.orange, frames.gains[f], f == 0);
    green.add(row.green, frames.gains[f], f == 0);
  }
  PixelStatistics each(frames);
  const auto n = static_cast<float>(frames.bgr.size());
  const auto width = static_cast<size_t>(frames.width);
  for (size_t x = 0; x < width; ++x) {
    const bool still = std::max({luma.range(x), orange.range(x), green.range(x)}) <= frames.reach &&
                       frames.all_count(y * width + x);
    set_pixel(model, y * width + x,
              still ? Statistics{luma.mean(x, n), orange.mean(x, n), green.mean(x, n),
                                 luma.variance(x, n),
                                 0.5F * (orange.variance(x, n) + green.variance(x, n))}
                    : each.of(y * width + x));
  }
}

// Measures the brightness of each frame relative to the mean of the points over all frames.
void measure_light(Frames& frames) {
  BackgroundModel model = sized(frames.width, frames.height);
  PixelStatistics statistics(frames);
  for (const LightPoint& point : light_points(frames.width, frames.height))
    set_pixel(model, point.pixel, statistics.of(point.pixel));
  for (size_t f = 0; f < frames.bgr.size(); ++f)
    frames.gains[f] = static_cast<float>(light_gain(model, frames.image(f)));
}

// Square of the largest difference of a channel to the four neighbours, which is the error if the
// image shakes by a pixel.
float squared_step(const std::vector<float>& channel, int x, int y, int width, int height) {
  const auto at = [&](int column, int row) {
    return channel[static_cast<size_t>(row) * static_cast<size_t>(width) +
                   static_cast<size_t>(column)];
  };
  const float here = at(x, y);
  const float dx = std::max(std::abs(here - at(std::max(x - 1, 0), y)),
                            std::abs(here - at(std::min(x + 1, width - 1), y)));
  const float dy = std::max(std::abs(here - at(x, std::max(y - 1, 0))),
                            std::abs(here - at(x, std::min(y + 1, height - 1))));
  return dx * dx + dy * dy;
}

void floor_variances(const BackgroundConfig& config, BackgroundModel& model) {
  const auto noise = static_cast<float>(config.noise * config.noise);
  const auto jitter = static_cast<float>(config.jitter_px * config.jitter_px);
  size_t i = 0;
  for (int y = 0; y < model.height; ++y) {
    for (int x = 0; x < model.width; ++x, ++i) {
      const auto step = [&](const std::vector<float>& channel) {
        return jitter * squared_step(channel, x, y, model.width, model.height);
      };
      const float luma = std::max(model.luma_precision[i], noise + step(model.luma));
      const float chroma = std::max(model.chroma_precision[i],
                                    noise + 0.5F * (step(model.orange) + step(model.green)));
      model.luma_precision[i] = 1 / luma;
      model.chroma_precision[i] = 1 / chroma;
    }
  }
}

}  // namespace

BackgroundSampler::BackgroundSampler(const BackgroundConfig& config) : config_(config) {}

bool BackgroundSampler::takes_next() {
  if (seen_++ % stride_ != 0) return false;
  if (static_cast<int>(kept_.size()) >= std::max(2, config_.samples)) {
    size_t half = 0;
    for (size_t i = 0; i < kept_.size(); i += 2) kept_[half++].swap(kept_[i]);
    kept_.resize(half);
    stride_ *= 2;
    if ((seen_ - 1) % stride_ != 0) return false;
  }
  return true;
}

void BackgroundSampler::take(const cv::Mat& frame_bgr) {
  width_ = frame_bgr.cols;
  height_ = frame_bgr.rows;
  kept_.emplace_back();
  for (int y = 0; y < height_; ++y)
    kept_.back().insert(kept_.back().end(), frame_bgr.ptr<uint8_t>(y),
                        frame_bgr.ptr<uint8_t>(y) + 3 * width_);
}

void BackgroundSampler::add(const cv::Mat& frame_bgr) {
  if (takes_next()) take(frame_bgr);
}

cv::Mat BackgroundSampler::frame(int index) const {
  const auto& bgr = kept_[static_cast<size_t>(index)];
  return {height_, width_, CV_8UC3, const_cast<uint8_t*>(bgr.data())};
}

void BackgroundSampler::show(const cv::Mat& frame_bgr) {
  if (!range_) {
    range_.emplace();
    for (int f = 0; f < frames(); ++f) add_range(frame(f), *range_);
  }
  add_range(frame_bgr, *range_);
}

bool BackgroundSampler::has_little_contrast() const { return range_ && range_->is_small(); }

float BackgroundSampler::noise() const {
  if (kept_.size() < 2) return 0;
  const auto count = static_cast<float>(kept_.size());
  std::vector<float> deviations;
  for (const LightPoint& point : light_points(width_, height_)) {
    float sum = 0, squares = 0;
    for (const auto& bgr : kept_) {
      const float luma = sample_at(bgr, point.pixel, 1).luma;
      sum += luma;
      squares += luma * luma;
    }
    deviations.push_back(std::sqrt(std::max(0.F, squares - sum * sum / count) / (count - 1)));
  }
  const auto middle = deviations.begin() + static_cast<std::ptrdiff_t>(deviations.size() / 2);
  std::nth_element(deviations.begin(), middle, deviations.end());
  return *middle;
}

PictureChange BackgroundSampler::change() const {
  const std::vector<LightPoint> points = light_points(width_, height_);
  std::vector<float> luma, chroma;
  luma.reserve(kept_.size() * points.size());
  chroma.reserve(points.size());
  for (const LightPoint& point : points) {
    Sample sum{};
    for (const auto& bgr : kept_) {
      const Sample sample = sample_at(bgr, point.pixel, 1);
      luma.push_back(sample.luma);
      sum.orange += sample.orange;
      sum.green += sample.green;
    }
    // Of the mean, because noise has colours, too.
    chroma.push_back(std::max(std::abs(sum.orange), std::abs(sum.green)) /
                     static_cast<float>(kept_.size()));
  }
  PictureChange out;
  out.levels = levels_of_dark(luma);
  if (!out.levels.stretch() && range_) out.levels = range_->levels(noise());
  out.colourless = is_colourless(chroma, out.levels.gain);
  return out;
}

void BackgroundSampler::hide(int index, const cv::Mat& mask) {
  hidden_.resize(kept_.size());
  auto& hidden = hidden_[static_cast<size_t>(index)];
  hidden.clear();
  for (int y = 0; y < mask.rows; ++y)
    hidden.insert(hidden.end(), mask.ptr<uint8_t>(y), mask.ptr<uint8_t>(y) + mask.cols);
}

BackgroundModel BackgroundSampler::model(int threads) const {
  if (kept_.empty()) throw InputError("background: no frame to learn it from");
  std::vector<std::vector<uint8_t>> hidden = hidden_;
  hidden.resize(kept_.size());
  BackgroundModel model = sized(width_, height_);
  model.change = change();
  const bool changes = model.change.levels.stretch() || model.change.colourless;
  std::vector<std::vector<uint8_t>> as_compared;
  for (int f = 0; changes && f < static_cast<int>(kept_.size()); ++f)
    changed(frame(f), model.change).reshape(1, 1).copyTo(as_compared.emplace_back());
  Frames frames{width_, height_, changes ? as_compared : kept_, hidden, {}};
  frames.gains.assign(kept_.size(), 1);
  frames.reach *=
      std::sqrt(model.change.levels.gain);  // noise is larger, differences are too; by hand
  if (kept_.size() > 1) measure_light(frames);
  parallel_for(static_cast<size_t>(height_), threads,
               [&](size_t y) { fill_row(frames, y, model); });
  floor_variances(config_, model);
  return model;
}

}  // namespace observation
}  // namespace walktrack
