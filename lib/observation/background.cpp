#include "observation/background.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "core/conventions.h"
#include "core/errors.h"
#include "core/parallel_for.h"
#include "observation/shrink.h"

namespace walktrack {

namespace {

const float kLogTwoPi = static_cast<float>(std::log(2 * kPi));
const float kLogCube = static_cast<float>(3 * std::log(256.0));  // volume of all colours

struct Statistics {
  float luma, orange, green, luma_variance, chroma_variance;
};

struct Sample {
  float luma, orange, green;
};

// Where most samples crowd in luma: the middle of the shortest run of sorted values that holds
// `share` of them (the shorth). Breaks down only when another colour fills a larger share.
size_t densest_run(const std::vector<Sample>& sorted, size_t length) {
  size_t best = 0;
  for (size_t i = 1; i + length <= sorted.size(); ++i) {
    const float spread = sorted[i + length - 1].luma - sorted[i].luma;
    if (spread < sorted[best + length - 1].luma - sorted[best].luma) best = i;
  }
  return best;
}

float median_of(std::vector<float>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Mean and variances of the samples within `reach` grey levels of the densest colour.
Statistics robust_statistics(std::vector<Sample>& samples, std::vector<float>& scratch) {
  constexpr float kReach = 18;
  std::sort(samples.begin(), samples.end(),
            [](const Sample& a, const Sample& b) { return a.luma < b.luma; });
  const size_t length = (2 * samples.size() + 4) / 5;
  const size_t begin = densest_run(samples, length);
  const auto middle = [&](float Sample::*channel) {
    scratch.clear();
    for (size_t i = begin; i < begin + length; ++i) scratch.push_back(samples[i].*channel);
    return median_of(scratch);
  };
  const Sample mode{middle(&Sample::luma), middle(&Sample::orange), middle(&Sample::green)};
  float n = 0, s[3] = {}, q[3] = {};
  for (const Sample& x : samples) {
    const float d[3] = {x.luma - mode.luma, x.orange - mode.orange, x.green - mode.green};
    if (std::abs(d[0]) > kReach || std::abs(d[1]) > kReach || std::abs(d[2]) > kReach) continue;
    n += 1;
    for (int c = 0; c < 3; ++c) {
      s[c] += d[c];
      q[c] += d[c] * d[c];
    }
  }
  const auto variance = [&](int c) { return (q[c] - s[c] * s[c] / n) / std::max(1.F, n - 1); };
  return {mode.luma + s[0] / n, mode.orange + s[1] / n, mode.green + s[2] / n, variance(0),
          0.5F * (variance(1) + variance(2))};
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

// What was kept of the frames: BGR, and the strength of the light in each.
struct Frames {
  const std::vector<std::vector<uint8_t>>& bgr;
  std::vector<float> gains;
};

// Works pixels out one after the other.
class PixelStatistics {
 public:
  PixelStatistics(const Frames& frames, BackgroundModel& model)
      : frames_(frames), model_(model), samples_(frames.bgr.size()) {}

  // Puts variances in the place of precisions, until floor_variances.
  void fill(size_t pixel) {
    for (size_t f = 0; f < samples_.size(); ++f)
      samples_[f] = sample_at(frames_.bgr[f], pixel, frames_.gains[f]);
    const Statistics s = robust_statistics(samples_, scratch_);
    model_.luma[pixel] = s.luma;
    model_.orange[pixel] = s.orange;
    model_.green[pixel] = s.green;
    model_.luma_precision[pixel] = s.luma_variance;
    model_.chroma_precision[pixel] = s.chroma_variance;
  }

 private:
  const Frames& frames_;
  BackgroundModel& model_;
  std::vector<Sample> samples_;
  std::vector<float> scratch_;
};

struct Pixel {
  int x, y;
};

// Where the light is measured: a grid over the image.
constexpr int kLightGrid = 48;  // points along either side

std::array<Pixel, kLightGrid * kLightGrid> light_grid(int width, int height) {
  constexpr int kHalves = 2 * kLightGrid;
  std::array<Pixel, kLightGrid * kLightGrid> grid;
  for (int k = 0; k < kLightGrid * kLightGrid; ++k) {
    const int column = k % kLightGrid, row = k / kLightGrid;
    grid[static_cast<size_t>(k)] = {(2 * column + 1) * width / kHalves,
                                    (2 * row + 1) * height / kHalves};
  }
  return grid;
}

size_t index_of(const BackgroundModel& model, const Pixel& pixel) {
  return static_cast<size_t>(pixel.y) * static_cast<size_t>(model.width) +
         static_cast<size_t>(pixel.x);
}

// The strength of the light in each frame, against what the grid's points look like throughout.
void measure_light(int width, int height, Frames& frames) {
  BackgroundModel model = sized(width, height);
  PixelStatistics statistics(frames, model);
  for (const Pixel& point : light_grid(width, height)) statistics.fill(index_of(model, point));
  for (size_t f = 0; f < frames.bgr.size(); ++f) {
    const cv::Mat frame(height, width, CV_8UC3, const_cast<uint8_t*>(frames.bgr[f].data()));
    frames.gains[f] = static_cast<float>(light_gain(model, frame));
  }
}

// Square of the largest step of a channel to the four neighbours: what a shake by a pixel changes.
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

// ln x for positive normal x, within 1e-4: exponent by the bits, mantissa by a polynomial. Simple
// enough to be computed for several pixels at once.
inline float fast_log(float x) {
  const auto bits = std::bit_cast<int32_t>(x);
  const auto exponent = static_cast<float>((bits >> 23) - 127);
  const float m = std::bit_cast<float>((bits & 0x007fffff) | 0x3f800000);
  const float p =
      -1.7417939F + (2.8212026F + (-1.4699568F + (0.44717955F - 0.056570851F * m) * m) * m) * m;
  return 0.69314718F * exponent + p;
}

// Beside a shadow's or a body's edge the gradient is anything, though the pixel is background: the
// log of the share of such pixels.
constexpr float kLogEdge = -3.0F;

// Constants of the mixture.
struct Weights {
  explicit Weights(const BackgroundConfig& c)
      : log_plain(static_cast<float>(std::log(1 - c.shadow_share - c.unknown_share)) -
                  1.5F * kLogTwoPi),
        log_shadow(
            static_cast<float>(std::log(c.shadow_share / (1 - c.shadow_darkest) / (2 * kPi)))),
        log_unknown(static_cast<float>(std::log(c.unknown_share)) - kLogCube),
        darkest(static_cast<float>(c.shadow_darkest)),
        tint(static_cast<float>(c.shadow_tint * c.shadow_tint)),
        sky(static_cast<float>(c.shadow_sky * c.shadow_sky)),
        gradient(static_cast<float>(c.gradient_weight)) {}
  float log_plain, log_shadow, log_unknown, darkest, tint, sky, gradient;
};

// Below this mean a pixel is black anyway and a shadow of it is no share of anything.
constexpr float kDarkestMean = 8;

// A row of a channel with its neighbours above and below (itself at the image's edge).
struct Rows {
  const float *above, *here, *below;
};

Rows rows_of(const std::vector<float>& channel, const PixelRect& area, int x, int y) {
  const auto row = [&](int at) {
    const int clamped = std::clamp(at, area.y0, area.y1 - 1) - area.y0;
    return channel.data() + static_cast<size_t>(clamped) * static_cast<size_t>(area.width()) +
           static_cast<size_t>(x - area.x0);
  };
  return {row(y - 1), row(y), row(y + 1)};
}

struct Gradient {
  float x, y;
};

Gradient slope(const Rows& rows, int x, int left, int right) {
  return {0.5F * (rows.here[x + right] - rows.here[x + left]),
          0.5F * (rows.below[x] - rows.above[x])};
}

// Luma gradients of whatever stands in front: heavy tails in all directions alike,
// p(g) = s / (2 pi (s^2 + |g|^2)^(3/2)).
float log_broad_gradient(const Gradient& g) {
  constexpr float kScale = 4;  // grey levels per px
  return fast_log(kScale) - kLogTwoPi - 1.5F * fast_log(kScale * kScale + g.x * g.x + g.y * g.y);
}

// One row of a frame and of the model; all pointers stand at the first pixel wanted.
struct PixelRows {
  Rows luma;
  const float *orange, *green;
  Rows mean;
  const float *mean_orange, *mean_green, *luma_precision, *chroma_precision;
  float gain;
};

// The header's density at one pixel; `left` and `right` lead to its neighbours.
[[gnu::always_inline]] inline float log_density(const Weights& w, const PixelRows& p, int x,
                                                int left, int right) {
  const Gradient seen = slope(p.luma, x, left, right), mean = slope(p.mean, x, left, right);
  const float luma = p.luma.here[x], mu = p.gain * p.mean.here[x];
  const float pl = p.luma_precision[x], pc = p.chroma_precision[x];
  // Independent errors of variance v in two pixels two apart: their slope has variance v / 2.
  const float pg = 2 * pl;
  const float fore_gradient = log_broad_gradient(seen);
  const auto log_gradient = [&](float a) {
    const float ex = seen.x - a * p.gain * mean.x, ey = seen.y - a * p.gain * mean.y;
    const float gauss = fast_log(pg) - kLogTwoPi - 0.5F * pg * (ex * ex + ey * ey);
    return w.gradient * std::max(kLogEdge, gauss - fore_gradient);
  };
  const auto miss = [&](float a, float chroma_precision) {
    const float al = luma - a * mu;
    const float ao = p.orange[x] - a * p.gain * p.mean_orange[x];
    const float ag = p.green[x] - a * p.gain * p.mean_green[x];
    return al * al * pl + (ao * ao + ag * ag) * chroma_precision;
  };
  const float plain =
      w.log_plain + 0.5F * fast_log(pl * pc * pc) - 0.5F * miss(1, pc) + log_gradient(1);
  const float bright = std::max(mu, kDarkestMean);
  const float a = std::min(1.F, std::max(w.darkest, luma / bright));
  const float sky = (1 - a) * bright;
  const float ps = pc / (1 + (w.tint + w.sky * sky * sky) * pc);
  const float shadow = w.log_shadow + fast_log(ps / bright) - 0.5F * miss(a, ps) + log_gradient(a);
  return std::max(w.log_unknown, std::max(plain, shadow));
}

float luma_at(const cv::Mat& bgr, int x, int y) {
  const uint8_t* p = bgr.ptr<uint8_t>(y) + 3 * x;
  return 0.25F * static_cast<float>(p[0] + 2 * p[1] + p[2]);
}

}  // namespace

BackgroundSampler::BackgroundSampler(const BackgroundConfig& config, int shrink)
    : config_(config), shrink_(shrink) {}

void BackgroundSampler::add(const cv::Mat& frame_bgr) {
  if (seen_++ % stride_ != 0) return;
  if (static_cast<int>(kept_.size()) >= std::max(2, config_.samples)) {
    size_t half = 0;
    for (size_t i = 0; i < kept_.size(); i += 2) kept_[half++].swap(kept_[i]);
    kept_.resize(half);
    stride_ *= 2;
    if ((seen_ - 1) % stride_ != 0) return;
  }
  const cv::Mat small = shrunk(frame_bgr, shrink_);
  width_ = small.cols;
  height_ = small.rows;
  kept_.emplace_back();
  for (int y = 0; y < small.rows; ++y)
    kept_.back().insert(kept_.back().end(), small.ptr<uint8_t>(y),
                        small.ptr<uint8_t>(y) + 3 * small.cols);
}

BackgroundModel BackgroundSampler::model(int threads) const {
  if (kept_.empty()) throw InputError("background: no frame to learn it from");
  Frames frames{kept_, std::vector<float>(kept_.size(), 1)};
  if (kept_.size() > 1) measure_light(width_, height_, frames);
  BackgroundModel model = sized(width_, height_);
  const auto width = static_cast<size_t>(width_);
  parallel_for(static_cast<size_t>(height_), threads, [&](size_t y) {
    PixelStatistics statistics(frames, model);
    for (size_t x = 0; x < width; ++x) statistics.fill(y * width + x);
  });
  floor_variances(config_, model);
  return model;
}

double light_gain(const BackgroundModel& model, const cv::Mat& bgr) {
  // Dark pixels have no reliable ratio, bright ones saturate.
  constexpr float kDark = 30, kBright = 225;
  const auto grid = light_grid(model.width, model.height);
  std::vector<float> ratios;
  ratios.reserve(grid.size());
  for (const Pixel& point : grid) {
    const float mean = model.luma[index_of(model, point)];
    const float seen = luma_at(bgr, point.x, point.y);
    if (mean > kDark && mean < kBright && seen < kBright) ratios.push_back(seen / mean);
  }
  return ratios.empty() ? 1.0 : static_cast<double>(median_of(ratios));
}

void background_log_density(const BackgroundModel& model, const BackgroundConfig& config,
                            const ColourPatch& patch, const PixelRect& area, int y, double gain,
                            std::span<float> out) {
  const Weights w(config);
  const PixelRect image{0, 0, model.width, model.height};
  const PixelRows rows{rows_of(patch.luma, patch.area, area.x0, y),
                       rows_of(patch.orange, patch.area, area.x0, y).here,
                       rows_of(patch.green, patch.area, area.x0, y).here,
                       rows_of(model.luma, image, area.x0, y),
                       rows_of(model.orange, image, area.x0, y).here,
                       rows_of(model.green, image, area.x0, y).here,
                       rows_of(model.luma_precision, image, area.x0, y).here,
                       rows_of(model.chroma_precision, image, area.x0, y).here,
                       static_cast<float>(gain)};
  const int end = area.width();
  const int first = area.x0 == 0 ? 1 : 0, last = area.x1 == model.width ? end - 1 : end;
  if (first == 1) out[0] = log_density(w, rows, 0, 0, 1);
  // Through a buffer that nothing else points to, so that several pixels can be computed at once.
  constexpr int kChunk = 64;
  for (int begin = first; begin < last; begin += kChunk) {
    std::array<float, kChunk> chunk;
    const int count = std::min(kChunk, last - begin);
    for (int k = 0; k < count; ++k)
      chunk[static_cast<size_t>(k)] = log_density(w, rows, begin + k, -1, 1);
    std::copy_n(chunk.begin(), count, out.begin() + begin);
  }
  if (last < end) out[static_cast<size_t>(last)] = log_density(w, rows, last, -1, 0);
}

void follow_drift(BackgroundModel& model, const BackgroundConfig& config, const cv::Mat& bgr,
                  double gain, int phase, int skip) {
  constexpr float kExplained = 9;  // squared deviation, three standard deviations
  const auto g = static_cast<float>(gain);
  const float rate = static_cast<float>(std::min(1.0, config.drift_rate * skip));
  for (int y = phase; y < model.height; y += skip) {
    const uint8_t* p = bgr.ptr<uint8_t>(y);
    size_t i = static_cast<size_t>(y) * static_cast<size_t>(model.width);
    for (int x = 0; x < model.width; ++x, ++i, p += 3) {
      const float b = p[0] / g, gr = p[1] / g, r = p[2] / g;
      const float dl = 0.25F * (r + 2 * gr + b) - model.luma[i];
      const float d_o = r - b - model.orange[i];
      const float dg = gr - 0.5F * (r + b) - model.green[i];
      const float luma_miss = dl * dl * model.luma_precision[i];
      const float chroma_miss = (d_o * d_o + dg * dg) * model.chroma_precision[i];
      if (luma_miss > kExplained || chroma_miss > kExplained) continue;
      model.luma[i] += rate * dl;
      model.orange[i] += rate * d_o;
      model.green[i] += rate * dg;
    }
  }
}

}  // namespace walktrack
