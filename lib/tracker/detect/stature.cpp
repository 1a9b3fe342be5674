#include "tracker/detect/stature.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tracker/motion/models/planar_body.h"

namespace walktrack {
inline namespace tracker {

namespace {

// Heights are tried in such steps or in one deviation of what is known, in these bounds, m.
constexpr double kWidestStep = 0.05, kLeast = 0.8, kMost = 2.3;
// People differ from the figures not only in size but also in hair, shoes and posture. By hand; the
// errors of estimated heights are 13 to 25 mm (reports/search.md).
constexpr double kOtherSd = 0.02;  // m

double log_prior(const Stature& known, double height) {
  const double strange = (height - known.height) / known.sd;
  return -0.5 * strange * strange;
}

// The height after the images: the posterior of the figures has its top there, with that curvature,
// but people differ from the figures, so that the images know less than that, in the next video of
// the same person as well.
Stature with_images(const Stature& known, double top, double curvature) {
  const double before = 1 / (known.sd * known.sd), images = curvature - before;
  if (images < 1e-9 * before) return known;
  const double seen = top + (top - known.height) * before / images;
  const double believed = 1 / (1 / images + kOtherSd * kOtherSd);
  const double after = before + believed;
  const double sd = std::max(1 / std::sqrt(after), std::min(known.sd, kOtherSd));
  return {(before * known.height + believed * seen) / after, sd};
}

struct Fit {
  SizedWalk sized;
  double log_posterior;
};

}  // namespace

SizedWalk size_up(const DetectedWalk& walk, double height, const Stature& known, size_t frames,
                  const FigureScore& score, double dt, const Eigen::Vector2d& camera_position) {
  const double step = std::min(kWidestStep, known.sd);
  const double looks = independent_looks(frames, dt) / (kStrangeFigure * kStrangeFigure);
  const auto fitted = [&](double tried, const DetectedWalk& from) {
    Fit fit{{{tried, 0}, nearest_walk(from, frames, score(tried), dt, camera_position)},
            log_prior(known, tried)};
    fit.log_posterior += looks * fit.sized.walk.score;
    return fit;
  };
  const auto next_to = [&](const Fit& fit, double by) {
    return fitted(fit.sized.stature.height + by, fit.sized.walk);
  };
  Fit middle = fitted(height, walk);
  Fit below = next_to(middle, -step), above = next_to(middle, step);
  while (below.log_posterior > middle.log_posterior && below.sized.stature.height > kLeast) {
    above = std::exchange(middle, below);
    below = next_to(middle, -step);
  }
  while (above.log_posterior > middle.log_posterior && above.sized.stature.height < kMost) {
    below = std::exchange(middle, above);
    above = next_to(middle, step);
  }
  // The parabola through the three, no flatter than what is known.
  const double prior = (step / known.sd) * (step / known.sd);
  const double bent =
      std::max(2 * middle.log_posterior - below.log_posterior - above.log_posterior, prior);
  const double shift =
      std::clamp(0.5 * (above.log_posterior - below.log_posterior) / bent, -1.0, 1.0);
  const double top = middle.sized.stature.height + step * shift;
  const Stature stature = with_images(known, top, bent / (step * step));
  SizedWalk out = next_to(middle, stature.height - middle.sized.stature.height).sized;
  out.stature.sd = stature.sd;
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
