#include "jobs/compare/compare_figures.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace walktrack {
inline namespace jobs {

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kMostDegrees = 1000;

std::vector<double> mean_curve(const std::vector<std::vector<double>>& curves) {
  std::vector<double> mean(curves.at(0).size());
  for (const auto& curve : curves)
    for (size_t k = 0; k < mean.size(); ++k)
      mean[k] += curve[k] / static_cast<double>(curves.size());
  return mean;
}

// A number as a curve with one point.
std::vector<std::vector<double>> as_curves(const std::vector<double>& values) {
  std::vector<std::vector<double>> curves;
  for (const double value : values) curves.push_back({value});
  return curves;
}

// Variance of the mean of the sample that is due to the bands of its results; nullopt if a result
// has none. The errors of both sides of a result are taken to be equal, those of two results to be
// independent.
std::optional<double> band_variance(const Sample& sample, size_t parameter) {
  double sum = 0;
  for (const ComparedTrial& trial : sample.group->trials) {
    double sd = 0;
    for (const size_t side : sample.sides)
      sd += trial.sides[side].band_sd[parameter] / static_cast<double>(sample.sides.size());
    if (!std::isfinite(sd)) return std::nullopt;
    sum += sd * sd;
  }
  const auto trials = static_cast<double>(sample.group->trials.size());
  return sum / (trials * trials);
}

// The quantile with Welch's degrees of freedom (Biometrika 34, 1947), which are taken to be
// infinite for the bands. `squares`: sum over the samples of variance^2 / (n - 1).
double quantile_of(double scatter, double bands, double squares) {
  const double whole = scatter + bands;
  const double degrees = squares > 0 ? whole * whole / squares : kMostDegrees;
  return students_t((1 - kCompareLevel) / 2, std::clamp(degrees, 1.0, kMostDegrees));
}

}  // namespace

std::vector<Comparison> comparisons_of(const std::vector<ComparedGroup>& groups) {
  if (groups.size() == 1) return {{"", {{"right", &groups[0], {1}}, {"left", &groups[0], {0}}}}};
  std::vector<Comparison> out{{"both", {}}, {"left", {}}, {"right", {}}};
  for (const ComparedGroup& group : groups) {
    out[0].samples.push_back({group.name, &group, {0, 1}});
    out[1].samples.push_back({group.name, &group, {0}});
    out[2].samples.push_back({group.name, &group, {1}});
  }
  return out;
}

std::vector<std::vector<double>> drawn_curves(const Sample& sample, size_t angle,
                                              CompareUnit unit) {
  std::vector<std::vector<double>> drawn;
  for (const ComparedTrial& trial : sample.group->trials) {
    std::vector<std::vector<double>> strides;
    for (const size_t side : sample.sides)
      strides.insert(strides.end(), trial.sides[side].curves[angle].begin(),
                     trial.sides[side].curves[angle].end());
    if (strides.empty()) continue;
    if (unit == CompareUnit::kTrials) strides = {mean_curve(strides)};
    drawn.insert(drawn.end(), strides.begin(), strides.end());
  }
  return drawn;
}

std::vector<double> drawn_values(const Sample& sample, size_t parameter, CompareUnit unit) {
  std::vector<double> drawn;
  for (const ComparedTrial& trial : sample.group->trials) {
    std::vector<double> values;
    for (const size_t side : sample.sides)
      values.insert(values.end(), trial.sides[side].values[parameter].begin(),
                    trial.sides[side].values[parameter].end());
    if (values.empty()) continue;
    if (unit == CompareUnit::kTrials) values = {sample_spread(values).mean};
    drawn.insert(drawn.end(), values.begin(), values.end());
  }
  return drawn;
}

bool ParameterDifference::exceeds() const { return std::abs(difference) > detectable; }

ParameterDifference parameter_difference(const Sample& sample, const Sample& reference,
                                         size_t parameter, const CompareJob& job) {
  ParameterDifference out{kNaN, kNaN, kNaN, kNaN, true};
  double scatter = 0, bands = 0, squares = 0;
  for (const Sample* one : {&sample, &reference}) {
    const SampleSpread spread = sample_spread(drawn_values(*one, parameter, job.unit));
    const auto n = static_cast<double>(spread.count);
    const double variance = spread.sd * spread.sd / n;
    scatter += variance;
    squares += variance * variance / (n - 1);
    const auto by_bands = band_variance(*one, parameter);
    bands += by_bands.value_or(0);
    out.with_bands = out.with_bands && by_bands;
  }
  const MeanDifference found = mean_difference(
      as_curves(drawn_values(sample, parameter, job.unit)),
      as_curves(drawn_values(reference, parameter, job.unit)), kCompareLevel, job.draws, job.seed);
  out.difference = found.difference[0];
  out.low = found.low[0];
  out.high = found.high[0];
  out.detectable = quantile_of(scatter, bands, squares) * std::sqrt(scatter + bands);
  return out;
}

}  // namespace jobs
}  // namespace walktrack
