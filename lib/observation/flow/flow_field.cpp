#include "observation/flow/flow_field.h"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "core/conventions.h"
#include "core/log_gamma.h"

namespace walktrack {
inline namespace observation {

namespace {

// By hand.
constexpr double kLattice = 0.045;  // m: three cells across a leg
constexpr double kReach = 0.7;      // m; a foot swings this far between frames at seven frames per
                                    // second
constexpr int kLeastReach = 16;     // px
// Smoothing in steps of the lattice, so that the pixels between those of the lattice contribute,
// too. By hand.
constexpr double kSmoothing = 0.4;
constexpr double kLeastSmoothing = 0.8;  // px
constexpr double kNats = 64;             // bound of a cell's sum, which is never reached

int lattice_step(const PixelRect& area, double metres_per_px) {
  const auto cells = [&](int step) {
    const auto count = [step](int px) { return static_cast<size_t>((px + step - 1) / step); };
    return count(area.width()) * count(area.height());
  };
  int step = std::max(1, static_cast<int>(std::lround(kLattice / metres_per_px)));
  while (cells(step) > kMaxFlowCells) ++step;
  return step;
}

cv::Mat smoothed(const cv::Mat& grey, double sigma) {
  cv::Mat out;
  grey.convertTo(out, CV_32F);
  cv::GaussianBlur(out, out, {0, 0}, sigma);
  return out;
}

cv::Rect rect_of(const PixelRect& area) { return {area.x0, area.y0, area.width(), area.height()}; }

// The grey levels of the empty scene, with OpenCV's weights of red, green and blue.
cv::Mat grey_of(const BackgroundModel& model, const PixelRect& area) {
  // Rec. ITU-R BT.601.
  constexpr float kRed = 0.299F, kGreen = 0.587F, kBlue = 0.114F;
  constexpr float kOfGreen = 0.5F - (kRed + kBlue);  // Y = G - Cg / 2
  constexpr float kOfOrange = 0.5F * (kRed - kBlue);
  static_assert(kRed + kGreen + kBlue == 1.0F);
  cv::Mat out(area.height(), area.width(), CV_32F);
  for (int y = 0; y < out.rows; ++y) {
    const size_t row = static_cast<size_t>(area.y0 + y) * static_cast<size_t>(model.width);
    for (int x = 0; x < out.cols; ++x) {
      const size_t i = row + static_cast<size_t>(area.x0 + x);
      out.at<float>(y, x) = model.luma[i] + kOfGreen * model.green[i] + kOfOrange * model.orange[i];
    }
  }
  return out;
}

constexpr double kLevels = 256;  // of grey, in 8 bits

// Log of background.h's mixture for grey levels alone.
class UncoveredDensity {
 public:
  explicit UncoveredDensity(const BackgroundConfig& c)
      : plain_((1 - c.shadow_share - c.unknown_share) / std::sqrt(2 * kPi)),
        shadow_(c.shadow_share / (1 - c.shadow_darkest)),
        darkest_(c.shadow_darkest),
        unknown_(c.unknown_share / kLevels) {}

  double log_density(double grey, double mean, double precision) const {
    const double off = grey - mean, bright = std::max<double>(mean, kDarkestMean);
    double density =
        unknown_ + plain_ * std::sqrt(precision) * std::exp(-0.5 * off * off * precision);
    if (grey < bright && grey > darkest_ * bright) density += shadow_ / bright;
    return std::log(density);
  }

 private:
  double plain_, shadow_, darkest_, unknown_;
};

// Log of the Student-t of a pixel at rest, about the same pixel of the previous frame.
class RestDensity {
 public:
  explicit RestDensity(const FlowConfig& c)
      : dof_(c.dof),
        peak_(log_t_peak(c.dof)),
        noise2_(c.noise * c.noise),
        error2_(c.error_px * c.error_px) {}

  double log_density(double grey, const EarlierPixel& was) const {
    const double off = grey - static_cast<double>(was.grey);
    const double scale2 = noise2_ + error2_ * static_cast<double>(was.slope2);
    return peak_ + 0.5 * dof_ * std::log(scale2) -
           0.5 * (dof_ + 1) *
               std::log(dof_ * scale2 +
                        std::min(off * off, static_cast<double>(kStrangest) * scale2));
  }

 private:
  double dof_, peak_, noise2_, error2_;
};

// Defines the lattice over out.area, and the part of the image around it that may be compared.
void lay_lattice(const PixelRect& image, double metres_per_px, FlowField& out) {
  const PixelRect& area = out.area;
  out.step = lattice_step(area, metres_per_px);
  out.columns = (area.width() + out.step - 1) / out.step;
  out.rows = (area.height() + out.step - 1) / out.step;
  const int reach = std::max(kLeastReach, static_cast<int>(std::lround(kReach / metres_per_px)));
  out.known =
      intersection({area.x0 - reach, area.y0 - reach, area.x1 + reach, area.y1 + reach}, image);
}

const EarlierPixel& pixel_before(const FlowField& field, int x, int y) {
  return field
      .before[static_cast<size_t>(y - field.known.y0) * static_cast<size_t>(field.known.width()) +
              static_cast<size_t>(x - field.known.x0)];
}

double luma_precision(const BackgroundModel& model, int x, int y) {
  return static_cast<double>(
      model.luma_precision[static_cast<size_t>(y) * static_cast<size_t>(model.width) +
                           static_cast<size_t>(x)]);
}

void keep_before(const cv::Mat& past, FlowField& out) {
  cv::Mat gradient_x, gradient_y;  // grey levels per px
  cv::Sobel(past, gradient_x, CV_32F, 1, 0, 3, 1.0 / 8);
  cv::Sobel(past, gradient_y, CV_32F, 0, 1, 3, 1.0 / 8);
  out.before.resize(past.total());
  size_t i = 0;
  for (int y = 0; y < past.rows; ++y) {
    const float *grey = past.ptr<float>(y), *gx = gradient_x.ptr<float>(y),
                *gy = gradient_y.ptr<float>(y);
    for (int x = 0; x < past.cols; ++x, ++i)
      out.before[i] = {grey[x], gx[x] * gx[x] + gy[x] * gy[x]};
  }
}

}  // namespace

double log_t_peak(double dof) {
  constexpr double kAnything = 0.1;  // share of pixels; by hand
  return std::log(1 - kAnything) + log_gamma(0.5 * (dof + 1)) - log_gamma(0.5 * dof) -
         0.5 * std::log(kPi) + 0.5 * dof * std::log(dof);
}

double light_gain(const GreyImage& before, const GreyImage& now) {
  // Dark pixels have no reliable ratio, bright ones saturate. By hand, grey levels.
  constexpr int kDark = 30, kBright = 225;
  std::vector<double> ratios;
  for (const LightPoint& point : light_points(now.width, now.height)) {
    const int was = before.pixels[point.pixel], is = now.pixels[point.pixel];
    if (std::min(was, is) > kDark && std::max(was, is) < kBright)
      ratios.push_back(static_cast<double>(is) / was);
  }
  if (ratios.empty()) return 1;
  const auto middle = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2);
  std::nth_element(ratios.begin(), middle, ratios.end());
  return *middle;
}

void make_flow_field(const ObservationConfig& config, const GreyImage& before, const GreyImage& now,
                     const FlowBackground& background, const PixelRect& area, double metres_per_px,
                     FlowField& out) {
  out.cells.clear();
  out.area = area;
  if (area.empty()) return;
  lay_lattice({0, 0, now.width, now.height}, metres_per_px, out);
  const double sigma = std::max(kLeastSmoothing, kSmoothing * out.step);
  const cv::Mat past =
      smoothed(view_of(before)(rect_of(out.known)), sigma) * light_gain(before, now);
  keep_before(past, out);
  const cv::Mat present = smoothed(view_of(now)(rect_of(area)), sigma);
  cv::Mat empty;
  if (background.model) empty = smoothed(grey_of(*background.model, area), sigma);
  const RestDensity at_rest(config.flow);
  const UncoveredDensity density(config.background);
  for (int y = 0; y < area.height(); y += out.step)
    for (int x = 0; x < area.width(); x += out.step) {
      const double grey = static_cast<double>(present.at<float>(y, x));
      const double rest = at_rest.log_density(grey, pixel_before(out, area.x0 + x, area.y0 + y));
      double uncovered = -std::log(kLevels);
      if (background.model)
        uncovered =
            density.log_density(grey, background.gain * static_cast<double>(empty.at<float>(y, x)),
                                luma_precision(*background.model, area.x0 + x, area.y0 + y));
      out.cells.push_back({static_cast<float>(grey), static_cast<float>(rest),
                           static_cast<float>(uncovered - rest)});
    }
}

void block(const cv::Mat& blocked, FlowField& field) {
  if (field.cells.empty()) return;
  // Pixels that smoothing mixes with those of an occluder give no evidence.
  const int reach = std::max(2, field.step);
  cv::Mat near;
  cv::dilate(blocked, near, cv::Mat::ones(2 * reach + 1, 2 * reach + 1, CV_8U));
  auto pixel = field.before.begin();
  for (int y = field.known.y0; y < field.known.y1; ++y)
    for (int x = field.known.x0; x < field.known.x1; ++x, ++pixel)
      if (near.at<uint8_t>(y, x)) pixel->slope2 = -1;
  auto cell = field.cells.begin();
  for (int row = 0; row < field.rows; ++row)
    for (int column = 0; column < field.columns; ++column, ++cell)
      if (near.at<uint8_t>(field.area.y0 + row * field.step, field.area.x0 + column * field.step))
        *cell = {-1, 0, 0};
}

void finish_flow_field(FlowField& field) {
  if (field.cells.empty()) return;
  resize(field.uncovered, {0, 0, field.columns, field.rows}, 1);
  std::vector<float> row(static_cast<size_t>(field.columns));
  for (int y = 0; y < field.rows; ++y) {
    const auto from = field.cells.begin() + static_cast<std::ptrdiff_t>(y) * field.columns;
    std::transform(from, from + field.columns, row.begin(),
                   [](const FlowCell& cell) { return cell.uncovered; });
    set_row(field.uncovered, 0, y, row, kNats);
  }
}

}  // namespace observation
}  // namespace walktrack
