#include "tracker/figure/trunk_length.h"

#include <cmath>

namespace walktrack {
inline namespace tracker {

namespace {

// By how much a length has to differ from the usual one to be tried, and from one that is tried
// already. Bent knees lower a head as well, so that a short trunk has to be clearer: with 3 cm,
// people whose trunk is nearly usual are placed worse (tracker/reports/trunk.md).
constexpr double kShorter = 0.05, kLonger = 0.03, kStillOther = 0.02;  // m
constexpr double kMostUnusual = 0.12;  // m, from the usual length; by hand
constexpr double kTrunkStep = 0.02;    // m, between lengths that are compared

}  // namespace

Body with_trunk(const Body& body, std::optional<double> length) {
  Subject subject = body.subject;
  subject.lengths.trunk = length;
  return make_body(subject, body.groups);
}

std::optional<double> other_trunk(const StartPoses& start) {
  const Body& body = start.scene.model.body;
  const double usual = with_trunk(body, std::nullopt).lengths.trunk, now = body.lengths.trunk;
  const double best =
      best_value({now, kTrunkStep, usual - kMostUnusual, usual + kMostUnusual},
                 [&](double length) { return outlines_score(start, with_trunk(body, length)); });
  const double least = now != usual ? kStillOther : best < usual ? kShorter : kLonger;
  const bool other = std::abs(best - now) >= least;
  return other ? std::optional(best) : std::nullopt;
}

}  // namespace tracker
}  // namespace walktrack
