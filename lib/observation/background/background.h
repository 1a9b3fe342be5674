// The model of the empty scene: the appearance of each pixel without the subject, and the
// probability of a frame's pixels under it.
//
// Per pixel: mean of (Y, Co, Cg), a variance of luma and one of chroma, and the luma gradient
// of the mean image. With I the observed pixel, mu the mean times the frame's gain:
//   p(I | background) = max of
//     (1 - s - e) N(I; mu, variances)                             the background itself
//     s  U(a; darkest..1) N(chroma; a mu, tint)                   in a cast shadow, I_Y = a mu_Y
//     e  U(colour cube)                                           something never seen
// The first two are multiplied by the density of the luma gradient, which is normal around that of
// the mean (times a), or uniform for the one pixel in ten that is beside an edge. The maximum
// replaces the sum, because the parts hardly overlap.
//
// Variances are at least those of the sensor noise plus that of an edge that moves by `jitter_px`,
// so that a model can be made from a single image.
#pragma once

#include <cstdint>
#include <vector>

#include "observation/background/colour.h"
#include "observation/background/picture_change.h"
#include "observation/observation_config.h"

namespace walktrack {
inline namespace observation {

// Precision of a pixel that hardly any frame shows without people: the background behind them is
// unknown, and the pixel gives no evidence. It is far below the precision of every other pixel.
inline constexpr float kNeverSeen = 1e-6F;
inline bool never_seen(float precision) { return precision <= 2 * kNeverSeen; }

// A pixel with a mean below this is black, so that the ratio of a shadow is undefined. By hand.
inline constexpr float kDarkestMean = 8;

struct BackgroundModel {
  int width = 0, height = 0;
  PictureChange change;                    // the model is of pictures that are changed in this way
  double from_video = 0;                   // share of the pixels that are the video's, although
                                           // there are images of the empty scene (moved_things.h)
  std::vector<float> luma, orange, green;  // means
  std::vector<float> luma_precision, chroma_precision;  // 1 / variance
};

// The points of a grid over the image at which the brightness of the light is measured.
struct LightPoint {
  int x, y;
  size_t pixel;  // in row order
};
std::vector<LightPoint> light_points(int width, int height);

// Grey levels.
float luma_at(const cv::Mat& bgr, int x, int y);

// Brightness of `bgr` relative to the model: the median ratio of luma over those points.
double light_gain(const BackgroundModel& model, const cv::Mat& bgr);

// Logs of densities of one row of pixels, area.x0 <= x < area.x1, per cubed grey level. The
// gradient's density is relative to that of the foreground, which cancels from every log-ratio.
void background_log_density(const BackgroundModel& model, const BackgroundConfig& config,
                            const ColourPatch& patch, const PixelRect& area, int y, double gain,
                            std::span<float> out);

// Moves the means of every `skip`-th row, from row `phase` on, towards the pixels of the frame that
// the model explains, so that it follows slow changes of the light but does not learn a body.
void follow_drift(BackgroundModel& model, const BackgroundConfig& config, const cv::Mat& bgr,
                  double gain, int phase, int skip);

}  // namespace observation
}  // namespace walktrack
