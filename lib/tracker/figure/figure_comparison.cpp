#include "tracker/figure/figure_comparison.h"

#include <algorithm>
#include <utility>

#include "body/kinematics.h"
#include "observation/silhouette/silhouette_term.h"

namespace walktrack {
inline namespace tracker {

namespace {

// Where a parabola through three values a step apart has its top, in steps from the middle one,
// which is the largest.
double top_of_parabola(double below, double middle, double above) {
  const double bent = below - 2 * middle + above;
  return bent < 0 ? 0.5 * (below - above) / bent : 0;
}

}  // namespace

double outlines_score(const StartPoses& start, const Body& body) {
  const TrackerScene& scene = start.scene;
  double sum = 0;
  for (size_t i = 0; i < std::min(start.records.size(), start.window.size()); ++i) {
    if (!start.records[i].tracked) continue;
    const PosedBody posed(body, start.records[i].estimate.pose);
    sum += SilhouetteTerm::log_likelihood(scene.observation, start.window[i][0], scene.cameras[0],
                                          posed, nullptr);
  }
  return sum;
}

double best_value(const ComparedValues& values, const std::function<double(double)>& score) {
  const double step = values.step;
  double value = values.from, below = score(value - step), best = score(value),
         above = score(value + step);
  while (above > best && value < values.most) {
    value += step;
    below = std::exchange(best, above);
    above = score(value + step);
  }
  while (below > best && value > values.least) {
    value -= step;
    above = std::exchange(best, below);
    below = score(value - step);
  }
  const double found = value + step * top_of_parabola(below, best, above);
  return std::clamp(found, values.least, values.most);
}

}  // namespace tracker
}  // namespace walktrack
