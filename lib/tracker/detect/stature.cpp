#include "tracker/detect/stature.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tracker/motion/models/planar_body.h"

namespace walktrack {
inline namespace tracker {

namespace {

// The prior of the height: adults of both sexes, wide enough for others if the images show them. By
// hand.
constexpr double kUsual = 1.70, kUsualSd = 0.15;  // m
// Heights are tried in such steps, in these bounds, m.
constexpr double kStep = 0.05, kLeast = 0.8, kMost = 2.3;
// People differ from the figures not only in size but also in hair, shoes and posture. By hand; the
// errors of estimated heights are 13 to 25 mm (reports/search.md).
constexpr double kOtherSd = 0.02;  // m

double log_prior(double height) {
  const double strange = (height - kUsual) / kUsualSd;
  return -0.5 * strange * strange;
}

struct Fit {
  SizedWalk sized;
  double log_posterior;
};

}  // namespace

SizedWalk size_up(const DetectedWalk& walk, double height, size_t frames, const FigureScore& score,
                  double dt, const Eigen::Vector2d& camera_position) {
  const double looks = independent_looks(frames, dt) / (kStrangeFigure * kStrangeFigure);
  const auto fitted = [&](double tried, const DetectedWalk& from) {
    Fit fit{{{tried, 0}, nearest_walk(from, frames, score(tried), dt, camera_position)},
            log_prior(tried)};
    fit.log_posterior += looks * fit.sized.walk.score;
    return fit;
  };
  const auto next_to = [&](const Fit& fit, double step) {
    return fitted(fit.sized.stature.height + step, fit.sized.walk);
  };
  Fit middle = fitted(height, walk);
  Fit below = next_to(middle, -kStep), above = next_to(middle, kStep);
  while (below.log_posterior > middle.log_posterior && below.sized.stature.height > kLeast) {
    above = std::exchange(middle, below);
    below = next_to(middle, -kStep);
  }
  while (above.log_posterior > middle.log_posterior && above.sized.stature.height < kMost) {
    below = std::exchange(middle, above);
    above = next_to(middle, kStep);
  }
  // The parabola through the three, no flatter than the prior.
  const double bent = std::max(2 * middle.log_posterior - below.log_posterior - above.log_posterior,
                               (kStep / kUsualSd) * (kStep / kUsualSd));
  const double shift = 0.5 * (above.log_posterior - below.log_posterior) / bent;
  SizedWalk out = next_to(middle, kStep * std::clamp(shift, -1.0, 1.0)).sized;
  out.stature.sd = std::hypot(kStep / std::sqrt(bent), kOtherSd);
  return out;
}

BodyModel with_height(const BodyModel& model, double height) {
  BodyModel out = model;
  Subject subject = model.body.subject;
  subject.height = height;
  out.body = make_body(subject, model.body.groups);
  out.walker = kneed_model(kneed_parameters(subject, model.walker.parameters.gravity));
  out.walker.gravity = model.walker.gravity;
  return out;
}

}  // namespace tracker
}  // namespace walktrack
