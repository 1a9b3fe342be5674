#include "observation/background/background.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include <opencv2/core.hpp>

#include "core/conventions.h"

namespace walktrack {
inline namespace observation {

namespace {

const float kLogTwoPi = static_cast<float>(std::log(2 * kPi));
const float kLogCube = static_cast<float>(3 * std::log(256.0));  // volume of all colours

// ln x for positive normal x, within 1e-4: the exponent from the bits, the mantissa by a
// polynomial. It is simple enough to be vectorised.
inline float fast_log(float x) {
  const auto bits = std::bit_cast<int32_t>(x);
  const auto exponent = static_cast<float>((bits >> 23) - 127);
  const float m = std::bit_cast<float>((bits & 0x007fffff) | 0x3f800000);
  const float p =
      -1.7417939F + (2.8212026F + (-1.4699568F + (0.44717955F - 0.056570851F * m) * m) * m) * m;
  return 0.69314718F * exponent + p;
}

// Log of the share of background pixels whose gradient is arbitrary because they are beside the
// edge of a shadow or of a body. By hand.
constexpr float kLogEdge = -3.0F;

// Share of the tint of shadows that is left where chroma is zero: without any, shadows explain
// people in dark clothes; with all of it, people explain shadows (reports/colourless.md).
constexpr double kTintLeft = .5;

// Constants of the mixture.
struct Weights {
  Weights(const BackgroundConfig& c, bool colourless)
      : log_plain(static_cast<float>(std::log(1 - c.shadow_share - c.unknown_share)) -
                  1.5F * kLogTwoPi),
        log_shadow(
            static_cast<float>(std::log(c.shadow_share / (1 - c.shadow_darkest) / (2 * kPi)))),
        log_unknown(static_cast<float>(std::log(c.unknown_share)) - kLogCube),
        darkest(static_cast<float>(c.shadow_darkest)),
        tint(tint_share(colourless) * static_cast<float>(c.shadow_tint * c.shadow_tint)),
        sky(tint_share(colourless) * static_cast<float>(c.shadow_sky * c.shadow_sky)),
        gradient(static_cast<float>(c.gradient_weight)) {}
  static float tint_share(bool colourless) {
    return colourless ? static_cast<float>(kTintLeft * kTintLeft) : 1;
  }
  float log_plain, log_shadow, log_unknown, darkest, tint, sky, gradient;
};

// A row of a channel with the rows above and below (itself at the border of the image).
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

// Luma gradients of foreground: heavy tails in all directions, p(g) = s / (2 pi (s^2 +
// |g|^2)^(3/2)).
float log_broad_gradient(const Gradient& g) {
  constexpr float kScale = 4;  // grey levels per px; by hand
  return fast_log(kScale) - kLogTwoPi - 1.5F * fast_log(kScale * kScale + g.x * g.x + g.y * g.y);
}

// One row of a frame and of the model; all pointers refer to the first pixel of the area.
struct PixelRows {
  Rows luma;
  const float *orange, *green;
  Rows mean;
  const float *mean_orange, *mean_green, *luma_precision, *chroma_precision;
  float gain;
};

// The density in the header at one pixel; `left` and `right` are offsets of its neighbours.
[[gnu::always_inline]] inline float log_density(const Weights& w, const PixelRows& p, int x,
                                                int left, int right) {
  const Gradient seen = slope(p.luma, x, left, right), mean = slope(p.mean, x, left, right);
  const float luma = p.luma.here[x], mu = p.gain * p.mean.here[x];
  const float pl = p.luma_precision[x], pc = p.chroma_precision[x];
  // The slope between two pixels two apart with independent errors of variance v has variance v /
  // 2.
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

}  // namespace

float luma_at(const cv::Mat& bgr, int x, int y) {
  const uint8_t* p = bgr.ptr<uint8_t>(y) + 3 * x;
  return 0.25F * static_cast<float>(p[0] + 2 * p[1] + p[2]);
}

std::vector<LightPoint> light_points(int width, int height) {
  // Points along each side of the grid; by hand.
  constexpr int kSide = 48, kHalves = 2 * kSide;
  std::vector<LightPoint> points;
  points.reserve(size_t{kSide} * kSide);
  for (int k = 0; k < kSide * kSide; ++k) {
    const int x = (2 * (k % kSide) + 1) * width / kHalves;
    const int y = (2 * (k / kSide) + 1) * height / kHalves;
    points.push_back(
        {x, y, static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)});
  }
  return points;
}

double light_gain(const BackgroundModel& model, const cv::Mat& bgr) {
  // Dark pixels have no reliable ratio, bright ones saturate. By hand, grey levels.
  constexpr float kDark = 30, kBright = 225;
  std::vector<float> ratios;
  for (const LightPoint& point : light_points(model.width, model.height)) {
    const float mean = model.luma[point.pixel];
    const float seen = luma_at(bgr, point.x, point.y);
    if (mean > kDark && mean < kBright && seen < kBright) ratios.push_back(seen / mean);
  }
  if (ratios.empty()) return 1;
  const auto middle = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2);
  std::nth_element(ratios.begin(), middle, ratios.end());
  return static_cast<double>(*middle);
}

void background_log_density(const BackgroundModel& model, const BackgroundConfig& config,
                            const ColourPatch& patch, const PixelRect& area, int y, double gain,
                            std::span<float> out) {
  if (area.width() == 0) return;  // a body outside the image covers nothing
  const Weights w(config, model.change.colourless);
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
  // A separate buffer without aliases, so that the loop can be vectorised.
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
  constexpr float kExplained = 9;  // squared deviation, i.e. three standard deviations
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

}  // namespace observation
}  // namespace walktrack
