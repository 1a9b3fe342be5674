#include "metrics/statistics/mean_difference.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "core/log_gamma.h"
#include "core/rng.h"
#include "metrics/statistics/statistics.h"

namespace walktrack {
inline namespace metrics {

namespace {

constexpr double kNoDifference = std::numeric_limits<double>::quiet_NaN();
using Curves = std::span<const std::vector<double>>;

// Moments of the mean, at every point.
struct Moments {
  std::vector<double> mean, error_squared;
};

Moments moments(Curves curves, std::span<const size_t> drawn) {
  const size_t points = curves[0].size();
  const auto n = static_cast<double>(drawn.size());
  Moments out{std::vector<double>(points), std::vector<double>(points)};
  for (const size_t i : drawn)
    for (size_t k = 0; k < points; ++k) out.mean[k] += curves[i][k] / n;
  for (const size_t i : drawn)
    for (size_t k = 0; k < points; ++k)
      out.error_squared[k] += (curves[i][k] - out.mean[k]) * (curves[i][k] - out.mean[k]);
  for (double& value : out.error_squared) value /= n * (n - 1);
  return out;
}

std::vector<size_t> all_of(Curves curves) {
  std::vector<size_t> all(curves.size());
  std::iota(all.begin(), all.end(), size_t{0});
  return all;
}

std::vector<size_t> draw(size_t count, Rng& rng) {
  std::vector<size_t> drawn(count);
  for (size_t& i : drawn)
    i = std::min(count - 1, static_cast<size_t>(rng.uniform() * static_cast<double>(count)));
  return drawn;
}

bool all_the_same(std::span<const size_t> drawn) {
  return std::all_of(drawn.begin(), drawn.end(), [&](size_t i) { return i == drawn[0]; });
}

double standard_error(const Moments& a, const Moments& b, size_t point) {
  return std::sqrt(a.error_squared[point] + b.error_squared[point]);
}

double greatest_deviation(const Moments& a, const Moments& b, std::span<const double> difference) {
  double greatest = 0;
  for (size_t k = 0; k < difference.size(); ++k) {
    const double off = std::abs(a.mean[k] - b.mean[k] - difference[k]);
    if (off > 0) greatest = std::max(greatest, off / standard_error(a, b, k));
  }
  return greatest;
}

}  // namespace

MeanDifference mean_difference(Curves a, Curves b, double level, size_t draws, uint64_t seed) {
  const Moments of_a = moments(a, all_of(a)), of_b = moments(b, all_of(b));
  MeanDifference out;
  for (size_t k = 0; k < of_a.mean.size(); ++k)
    out.difference.push_back(of_a.mean[k] - of_b.mean[k]);
  out.low.assign(out.difference.size(), kNoDifference);
  out.high = out.low;
  if (a.size() < kLeastForBand || b.size() < kLeastForBand) return out;
  std::vector<double> deviations;
  for (size_t i = 0; i < draws; ++i) {
    Rng rng(seed, Purpose::kResampling, 0, static_cast<uint32_t>(i));
    const auto from_a = draw(a.size(), rng), from_b = draw(b.size(), rng);
    if (all_the_same(from_a) || all_the_same(from_b)) continue;
    deviations.push_back(
        greatest_deviation(moments(a, from_a), moments(b, from_b), out.difference));
  }
  const double factor = quantile(std::move(deviations), level);
  for (size_t k = 0; k < out.difference.size(); ++k) {
    const double half = factor * standard_error(of_a, of_b, k);
    out.low[k] = out.difference[k] - half;
    out.high[k] = out.difference[k] + half;
  }
  return out;
}

SampleSpread sample_spread(std::span<const double> values) {
  const auto n = static_cast<double>(values.size());
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
  double squares = 0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return {values.size(), mean, values.size() > 1 ? std::sqrt(squares / (n - 1)) : kNoDifference};
}

// With t = sqrt(n) tan(phi), P(0 < T < t) = Gamma((n+1)/2) / (sqrt(pi) Gamma(n/2)) times the
// integral of cos^(n-1) from 0 to phi: smooth, by Simpson's rule.
double students_t(double tail, double degrees) {
  constexpr int kPieces = 400;  // of the integral
  const double scale =
      std::exp(log_gamma((degrees + 1) / 2) - log_gamma(degrees / 2)) / std::sqrt(std::numbers::pi);
  const auto share_below = [&](double phi) {
    double sum = 0;
    for (int i = 0; i <= kPieces; ++i) {
      const double factor = i == 0 || i == kPieces ? 1 : i % 2 == 1 ? 4 : 2;
      sum += factor * std::pow(std::cos(phi * i / kPieces), degrees - 1);
    }
    return scale * sum * phi / (3 * kPieces);
  };
  double low = 0, high = std::numbers::pi / 2;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (share_below(middle) < 0.5 - tail ? low : high) = middle;
  }
  return std::sqrt(degrees) * std::tan(low);
}

}  // namespace metrics
}  // namespace walktrack
