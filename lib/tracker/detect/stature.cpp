#include "tracker/detect/stature.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/conventions.h"
#include "tracker/motion/models/planar_body.h"

namespace walktrack {
inline namespace tracker {

namespace {

// Heights are tried in such steps or in one deviation of what is known, in these bounds, m.
constexpr double kWidestStep = 0.05, kLeast = 0.8, kMost = 2.3;
// Standard deviation of the height that images show: people differ from the figures not only in
// size but also in hair, shoes, clothes and posture (m), and outlines are blurred (pixels). From
// the errors that reports/search.md lists.
constexpr double kOtherSd = 0.02, kBlur_px = 5;
// Heights of people: adults of both sexes, and a few children, whose heights are anywhere between
// these. By hand.
constexpr Stature kAdults{1.70, 0.095};
constexpr double kChildren = 0.1, kSmallest = 0.9, kTallestChild = 1.6;

double log_normal_density(const Stature& known, double height) {
  const double strange = (height - known.height) / known.sd;
  return -0.5 * strange * strange - std::log(known.sd * std::sqrt(2 * kPi));
}

double log_prior(const std::optional<Stature>& known, double height) {
  if (known) return log_normal_density(*known, height);
  const bool child = height > kSmallest && height < kTallestChild;
  return std::log((1 - kChildren) * std::exp(log_normal_density(kAdults, height)) +
                  (child ? kChildren / (kTallestChild - kSmallest) : 0));
}

// What images say of a height: a normal density with that top; 0 where they give no evidence.
struct SeenHeight {
  double height, precision;  // m, 1/m^2
};

// Without what was known before: the posterior has its top there, with that curvature.
SeenHeight seen_by_images(const std::optional<Stature>& known, double top, double curvature,
                          double error_sd) {
  constexpr double kStep = 0.01;  // m
  const double below = log_prior(known, top - kStep), here = log_prior(known, top),
               above = log_prior(known, top + kStep);
  const double slope = (above - below) / (2 * kStep),
               bent = (2 * here - above - below) / (kStep * kStep);
  const double images = curvature - bent;
  if (images < 1e-6 * curvature) return {top, 0};
  return {top - slope / images, 1 / (1 / images + error_sd * error_sd)};
}

// Mean and standard deviation of what was known times what is seen, summed over all heights. The
// figures are wrong by as much in the next video of the same person, so that a height never becomes
// more certain than they are right.
Stature believed(const std::optional<Stature>& known, const SeenHeight& seen, double error_sd) {
  constexpr double kStep = 0.001, kFar = 1;  // m
  const auto log_density = [&](double height) {
    const double off = height - seen.height;
    return log_prior(known, height) - 0.5 * seen.precision * off * off;
  };
  const double middle = known ? known->height : seen.height;
  double highest = -std::numeric_limits<double>::infinity();
  for (double off = -kFar; off <= kFar; off += kStep)
    highest = std::max(highest, log_density(middle + off));
  double sum = 0, first = 0, second = 0;
  for (double off = -kFar; off <= kFar; off += kStep) {
    const double weight = std::exp(log_density(middle + off) - highest);
    sum += weight;
    first += weight * off;
    second += weight * off * off;
  }
  const double mean = first / sum;
  const double sd = std::sqrt(std::max(0.0, second / sum - mean * mean));
  return {middle + mean, known ? std::max(sd, std::min(known->sd, error_sd)) : sd};
}

struct Fit {
  SizedWalk sized;
  double log_posterior;
};

}  // namespace

SizedWalk size_up(const DetectedWalk& walk, double height, const std::optional<Stature>& known,
                  const FigureScore& score, const SizedWindow& window) {
  const double spread = known.value_or(kAdults).sd, step = std::min(kWidestStep, spread);
  const double looks =
      independent_looks(window.frames, window.dt) / (kStrangeFigure * kStrangeFigure);
  const auto fitted = [&](double tried, const DetectedWalk& from) {
    Fit fit{{{tried, 0},
             nearest_walk(from, window.frames, score(tried), window.dt, window.camera_position,
                          window.known)},
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
  const double prior = (step / spread) * (step / spread);
  const double bent =
      std::max(2 * middle.log_posterior - below.log_posterior - above.log_posterior, prior);
  const double shift =
      std::clamp(0.5 * (above.log_posterior - below.log_posterior) / bent, -1.0, 1.0);
  const double top = middle.sized.stature.height + step * shift;
  const double error_sd = std::hypot(kOtherSd, kBlur_px * window.metres_per_px);
  const Stature stature =
      believed(known, seen_by_images(known, top, bent / (step * step), error_sd), error_sd);
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
