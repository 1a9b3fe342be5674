#include "core/log_weights.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace walktrack {
inline namespace core {

namespace {

constexpr double kDead = -std::numeric_limits<double>::infinity();

double largest(std::span<const double> log_weights) {
  double best = kDead;
  for (const double w : log_weights) best = std::max(best, w);
  return best;
}

}  // namespace

double log_sum_exp(std::span<const double> log_weights) {
  const double offset = largest(log_weights);
  if (offset == kDead) return kDead;
  double sum = 0;
  for (const double w : log_weights) sum += std::exp(w - offset);
  return offset + std::log(sum);
}

std::vector<double> normalised_weights(std::span<const double> log_weights) {
  const double total = log_sum_exp(log_weights);
  std::vector<double> weights(log_weights.size(), 0.0);
  if (total == kDead) return weights;
  for (size_t i = 0; i < weights.size(); ++i) weights[i] = std::exp(log_weights[i] - total);
  return weights;
}

double effective_sample_size(std::span<const double> log_weights) {
  return effective_sample_size(log_weights, 1.0);
}

double effective_sample_size(std::span<const double> log_weights, double exponent) {
  const double offset = largest(log_weights);
  if (offset == kDead) return 0.0;
  double sum = 0, sum_of_squares = 0;
  for (const double w : log_weights) {
    if (w == kDead) continue;  // 0 * -infinity has no value
    const double p = std::exp(exponent * (w - offset));
    sum += p;
    sum_of_squares += p * p;
  }
  return sum * sum / sum_of_squares;
}

}  // namespace core
}  // namespace walktrack
