#include "tracker/overlaps.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/median.h"

namespace walktrack {
inline namespace tracker {

namespace {

// By hand: a step, and about two strides.
constexpr double kLasts = 0.5, kBefore = 2;  // s
// An overlap counts for a fall if so much of the figure is in front of a known background. By hand.
constexpr double kLeastSeen = 0.5;

// The sum over frames of one camera.
struct OverlapSum {
  double overlap = 0, seen = 0;  // the former by how much is seen

  void add(const FigureFit& fit, size_t camera) {
    if (camera >= fit.overlap.size() || std::isnan(fit.overlap[camera])) return;
    overlap += fit.seen[camera] * fit.overlap[camera];
    seen += fit.seen[camera];
  }
  double mean() const {
    return seen > 0 ? overlap / seen : std::numeric_limits<double>::quiet_NaN();
  }
};

OverlapSum sum_of(std::span<const FigureFit> fits, size_t camera) {
  OverlapSum sum;
  for (const FigureFit& fit : fits) sum.add(fit, camera);
  return sum;
}

size_t cameras_of(std::span<const FigureFit> fits) {
  size_t count = 0;
  for (const FigureFit& fit : fits) count = std::max(count, fit.overlap.size());
  return count;
}

std::vector<double> known_overlaps(std::span<const FigureFit> fits, size_t camera) {
  std::vector<double> out;
  for (const FigureFit& fit : fits) {
    const OverlapSum own = sum_of({&fit, 1}, camera);
    if (own.seen >= kLeastSeen) out.push_back(own.mean());
  }
  return out;
}

}  // namespace

std::vector<double> mean_overlaps(std::span<const FigureFit> fits) {
  std::vector<double> out;
  for (size_t c = 0; c < cameras_of(fits); ++c) out.push_back(sum_of(fits, c).mean());
  return out;
}

double largest_overlap_fall(std::span<const FigureFit> fits, double dt, size_t newest) {
  const auto lasts = static_cast<size_t>(frames_in(kLasts, dt));
  double largest = 0;
  for (size_t c = 0; c < cameras_of(fits); ++c) {
    for (size_t end = std::max(3 * lasts, fits.size() - newest + 1); end <= fits.size(); ++end) {
      const size_t begin = end - lasts, first = end - std::min(end, frames_of_fall(dt));
      const std::vector<double> usual = known_overlaps(fits.subspan(first, begin - first), c);
      const OverlapSum sum = sum_of(fits.subspan(begin, lasts), c);
      if (usual.size() < 2 * lasts || 2 * sum.seen < static_cast<double>(lasts)) continue;
      largest = std::max(largest, median_of(usual) - sum.mean());
    }
  }
  return largest;
}

size_t frames_of_fall(double dt) { return static_cast<size_t>(frames_in(kLasts + kBefore, dt)); }

}  // namespace tracker
}  // namespace walktrack
