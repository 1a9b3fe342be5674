#include "tracker/detect/standing_start.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "tracker/motion/standing.h"

namespace walktrack {
inline namespace tracker {

namespace {

using Eigen::Vector2d;

// Mean score of the frames just before the walk; -infinity if nobody stands in all of them.
double score_just_before(const StandingScore& score, size_t frames, const Vector2d& place,
                         double heading) {
  double sum = 0;
  for (size_t back = 1; back <= frames; ++back) {
    const auto nats = score(back, place, heading);
    if (!nats) return -std::numeric_limits<double>::infinity();
    sum += *nats;
  }
  return sum / double(frames);
}

}  // namespace

Pose standing_pose(const BodyModel& model) {
  WalkerParticle particle;
  particle.aim = {1, 1};
  stand(particle);
  Pose pose = pose_of(model, particle.walker, Side::kLeft, particle.aim, Vector2d::Zero(),
                      particle.residual);
  pose.root.head<2>().setZero();
  return pose;
}

std::optional<StandingStart> standing_before(const DetectedWalk& walk, const StandingScore& score,
                                             double dt, const DetectorConfig& config) {
  // By hand.
  constexpr double kLook = 0.15, kGap = 0.15;  // s
  // In m, in front of the line's beginning.
  constexpr double kNearest = -0.4, kFarthest = 0.4, kStep = 0.05;
  constexpr double kAsGood = 0.6;  // of the score just before the walk; by hand
  const auto frames_of = [&](double s) {
    return static_cast<size_t>(std::max(1L, std::lround(s / dt)));
  };
  const Vector2d ahead = walk.velocity.normalized();
  const double heading = std::atan2(ahead.y(), ahead.x());
  StandingStart out{walk};
  out.detected.standing = true;
  double best = config.least_score;
  for (double at = kNearest; at <= kFarthest; at += kStep) {
    const Vector2d place = walk.position + at * ahead;
    const double mean = score_just_before(score, frames_of(kLook), place, heading);
    if (mean <= best) continue;
    best = mean;
    out.detected.position = place;
  }
  if (!(best > config.least_score)) return std::nullopt;
  const double least = std::max(config.least_score, kAsGood * best);
  double pending = 0;      // of the latest frames that explain too little
  bool seen_there = true;  // in all of these, by more than an empty scene
  const auto add_pending = [&](size_t frames) {
    out.frames = frames;
    out.score += std::exchange(pending, 0);
    seen_there = true;
  };
  for (size_t back = 1; back - out.frames <= frames_of(kGap); ++back) {
    const auto nats = score(back, out.detected.position, heading);
    if (!nats) {  // there is no frame before these
      if (seen_there) add_pending(back - 1);
      break;
    }
    pending += *nats;
    if (*nats < config.least_score) seen_there = false;
    if (*nats >= least) add_pending(back);
  }
  if (out.frames == 0) return std::nullopt;
  return out;
}

}  // namespace tracker
}  // namespace walktrack
