#include "kinetics/force_error.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kinetics/smoothing.h"

namespace walktrack {
inline namespace kinetics {

namespace {

using Eigen::Vector3d;

constexpr double kLongestGap = 1.5;  // rows; across a longer one nothing is interpolated
const Vector3d kUnknown = Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());

std::vector<Vector3d> sums(const GroundForces& forces) {
  std::vector<Vector3d> out;
  for (const auto& feet : forces.feet) out.push_back(feet[0] + feet[1]);
  return out;
}

double rate_of(const std::vector<double>& time) {
  return time.size() < 2 ? 0 : static_cast<double>(time.size() - 1) / (time.back() - time.front());
}

// Smooths each interval of known rows by itself; its ends, where smoothing depends on unknown
// values, become unknown.
void smooth(std::vector<Vector3d>& values, double rate, double cutoff_hz) {
  const auto is_known = [](const Vector3d& value) { return value.allFinite(); };
  const auto margin = static_cast<std::ptrdiff_t>(std::ceil(0.5 * rate / cutoff_hz));
  for (auto begin = values.begin(); begin != values.end();) {
    begin = std::find_if(begin, values.end(), is_known);
    const auto end = std::find_if_not(begin, values.end(), is_known);
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      std::vector<double> one;
      for (auto value = begin; value != end; ++value) one.push_back((*value)[axis]);
      one = low_pass(one, rate, cutoff_hz);
      for (size_t i = 0; i < one.size(); ++i) begin[static_cast<std::ptrdiff_t>(i)][axis] = one[i];
    }
    const auto cut = std::min(margin, end - begin);
    std::fill(begin, begin + cut, kUnknown);
    std::fill(end - cut, end, kUnknown);
    begin = end;
  }
}

Vector3d at_time(const std::vector<double>& times, const std::vector<Vector3d>& values,
                 double time) {
  constexpr double kRounding = 1e-6;  // s, precision of tables
  const auto after = std::lower_bound(times.begin(), times.end(), time - kRounding);
  if (after == times.end()) return kUnknown;
  const auto i = static_cast<size_t>(after - times.begin());
  if (*after <= time + kRounding) return values[i];
  if (i == 0 || times[i] - times[i - 1] > kLongestGap / rate_of(times)) return kUnknown;
  const double share = (time - times[i - 1]) / (times[i] - times[i - 1]);
  return (1 - share) * values[i - 1] + share * values[i];
}

}  // namespace

ForceErrors force_errors(const GroundForces& truth, const GroundForces& estimate,
                         double cutoff_hz) {
  std::vector<Vector3d> expected = sums(truth);
  smooth(expected, rate_of(truth.time), cutoff_hz);
  const std::vector<Vector3d> found = sums(estimate);
  ForceErrors out;
  double vertical = 0, horizontal = 0;
  for (size_t i = 0; i < truth.time.size(); ++i) {
    const Vector3d error = at_time(estimate.time, found, truth.time[i]) - expected[i];
    if (!error.allFinite()) continue;
    ++out.count;
    vertical += error.z() * error.z();
    horizontal += error.head<2>().squaredNorm();
  }
  if (out.count == 0) return out;
  out.vertical_rms = std::sqrt(vertical / static_cast<double>(out.count));
  out.horizontal_rms = std::sqrt(horizontal / static_cast<double>(out.count));
  return out;
}

}  // namespace kinetics
}  // namespace walktrack
