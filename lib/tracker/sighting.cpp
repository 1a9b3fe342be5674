#include "tracker/sighting.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/conventions.h"
#include "core/parallel_for.h"

namespace walktrack {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kLeastHeight_px = 24;  // a smaller figure shows no gait
constexpr double kApart = 0.5;          // m, between figures that count as two

struct Outline {
  std::optional<Vector2d> foot, head;
};

Outline outline(const Camera& camera, const Vector2d& position, double height) {
  return {project(camera, Vector3d(position.x(), position.y(), 0)),
          project(camera, Vector3d(position.x(), position.y(), height))};
}

bool wholly_inside(const Camera& camera, const Outline& figure) {
  const double half_width = 0.15 * (*figure.foot - *figure.head).norm();
  for (const auto& pixel : {*figure.foot, *figure.head}) {
    if (pixel.x() < half_width || pixel.x() > camera.width_px - half_width || pixel.y() < 0 ||
        pixel.y() > camera.height_px)
      return false;
  }
  return true;
}

bool visible_everywhere(std::span<const Camera> cameras, const Vector2d& position, double height) {
  for (const Camera& camera : cameras) {
    const Outline figure = outline(camera, position, height);
    if (!figure.foot || !figure.head) continue;
    if (!wholly_inside(camera, figure)) return false;
    if ((*figure.foot - *figure.head).norm() < kLeastHeight_px) return false;
  }
  return true;
}

// A straight walk and how much better it explains a frame than standing still does, nats.
struct Walk {
  Sighting line;
  double score;
};

// Mean score of the worst third of the frames: a line counts by where it fails, so that two things
// that stand still do not make a walk between them.
double worst_score(const WindowScore& score, const Sighting& line, size_t frames, size_t stride,
                   double dt) {
  std::vector<double> scores;
  for (size_t f = 0; f < frames; f += stride)
    scores.push_back(score(f, line.position + dt * double(f) * line.velocity));
  const size_t third = (scores.size() + 2) / 3;
  std::nth_element(scores.begin(), scores.begin() + long(third - 1), scores.end());
  return std::accumulate(scores.begin(), scores.begin() + long(third), 0.0) / double(third);
}

// The line's score less that of standing in its middle: somebody who stands there, or a thing
// that is always there, makes no walk.
double walking_score(const WindowScore& score, const Sighting& line, size_t frames, size_t stride,
                     double dt) {
  const Sighting still{line.position + 0.5 * dt * double(frames - 1) * line.velocity,
                       Vector2d::Zero()};
  return worst_score(score, line, frames, stride, dt) -
         std::max(0.0, worst_score(score, still, frames, stride, dt));
}

// Lines through a candidate of an early and one of a late frame, at a walking speed.
std::vector<Walk> proposed_walks(std::span<const std::vector<Place>> candidates, double dt,
                                 const SightingConfig& config) {
  const size_t early = candidates.size() / 6, late = candidates.size() - 1 - early;
  const double time = dt * double(late - early);
  std::vector<Walk> walks;
  for (const Place& from : candidates[early]) {
    for (const Place& to : candidates[late]) {
      const Vector2d velocity = (to.position - from.position) / time;
      if (velocity.norm() < config.slowest || velocity.norm() > config.fastest) continue;
      walks.push_back({{from.position - dt * double(early) * velocity, velocity}, 0});
    }
  }
  return walks;
}

// Climbs by a shrinking pattern of shifts of the line's two ends, down to a centimetre.
Walk refined(Walk walk, const WindowScore& score, size_t frames, double dt) {
  const double time = dt * double(frames - 1);
  for (double step = 0.24; step > 0.01; step *= 0.5) {
    for (bool better = true; better;) {
      better = false;
      for (int direction = 0; direction < 8; ++direction) {
        const Vector2d shift = (direction % 2 == 0 ? step : -step) *
                               (direction / 2 % 2 == 0 ? Vector2d::UnitX() : Vector2d::UnitY());
        Sighting line = walk.line;
        if (direction < 4) line.position += shift;
        line.velocity += (direction < 4 ? -shift : shift) / time;
        const double value = walking_score(score, line, frames, 1, dt);
        if (value <= walk.score) continue;
        walk = {line, value};
        better = true;
      }
    }
  }
  return walk;
}

// Nobody hidden or cut off: the score never falls far below its median.
bool seen_throughout(const Walk& walk, const WindowScore& score, size_t frames, double dt,
                     const SightingConfig& config) {
  std::vector<double> scores;
  for (size_t f = 0; f < frames; ++f)
    scores.push_back(score(f, walk.line.position + dt * double(f) * walk.line.velocity));
  const double least = *std::min_element(scores.begin(), scores.end());
  std::nth_element(scores.begin(), scores.begin() + long(scores.size() / 2), scores.end());
  return least >= config.least_score && least >= config.complete * scores[scores.size() / 2];
}

}  // namespace

double side_on_heading(const Camera& camera, const Vector2d& position) {
  const Vector3d eye = camera_centre(camera);
  return std::atan2(position.y() - eye.y(), position.x() - eye.x()) + 0.5 * kPi;
}

std::array<std::vector<PosedPart>, 3> upright_figures(const Body& body, const Vector2d& position,
                                                      double heading) {
  std::array<std::vector<PosedPart>, 3> figures;
  const double leg = body.lengths.thigh + body.lengths.shank;
  for (size_t k = 0; k < 3; ++k) {
    const double spread = rad_from_deg(12.0 * double(k));  // of either leg from the vertical
    Pose pose;
    pose.heading = heading;
    pose.root =
        Vector3d(position.x(), position.y(), leg * std::cos(spread) + body.lengths.ankle_height);
    pose.legs[0].hip_flexion = spread;
    pose.legs[1].hip_flexion = -spread;
    pose_parts(body, forward_kinematics(body, pose), figures[k]);
  }
  return figures;
}

std::vector<Vector2d> standing_places(std::span<const Camera> cameras, double height,
                                      const SightingConfig& config) {
  const Camera& camera = cameras[0];
  const double step = std::max(2.0, config.grid_px * camera.width_px / 640.0);
  std::vector<Vector2d> places;
  for (double v = 0; v < camera.height_px; v += 0.5 * step) {
    for (double u = 0; u < camera.width_px; u += step) {
      const auto ground = ground_point(camera, Vector2d(u, v));
      if (ground && visible_everywhere(cameras, ground->head<2>(), height))
        places.push_back(ground->head<2>());
    }
  }
  return places;
}

std::vector<Place> find_figures(const PlaceScore& score, std::span<const Vector2d> places,
                                const SightingConfig& config, int threads) {
  std::vector<double> scores(places.size());
  parallel_for(places.size(), threads, [&](size_t i) { scores[i] = score(places[i]); });
  std::vector<size_t> order(places.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](size_t a, size_t b) { return scores[a] > scores[b]; });
  std::vector<Place> found;
  for (const size_t i : order) {
    if (static_cast<int>(found.size()) >= config.candidates || scores[i] <= 0) break;
    const bool apart = std::all_of(found.begin(), found.end(), [&](const Place& place) {
      return (place.position - places[i]).norm() > kApart;
    });
    if (apart) found.push_back({places[i], scores[i]});
  }
  return found;
}

std::optional<Sighting> find_walk(std::span<const std::vector<Place>> candidates,
                                  const WindowScore& score, double dt, const SightingConfig& config,
                                  int threads) {
  constexpr size_t kRefined = 4, kStride = 3;
  const size_t frames = candidates.size();
  std::vector<Walk> walks = proposed_walks(candidates, dt, config);
  if (walks.empty()) return std::nullopt;
  parallel_for(walks.size(), threads, [&](size_t i) {
    walks[i].score = walking_score(score, walks[i].line, frames, kStride, dt);
  });
  std::stable_sort(walks.begin(), walks.end(),
                   [](const Walk& a, const Walk& b) { return a.score > b.score; });
  walks.resize(std::min(walks.size(), kRefined));
  parallel_for(walks.size(), threads, [&](size_t i) {
    walks[i].score = walking_score(score, walks[i].line, frames, 1, dt);
    walks[i] = refined(walks[i], score, frames, dt);
  });
  const Walk& best = *std::max_element(
      walks.begin(), walks.end(), [](const Walk& a, const Walk& b) { return a.score < b.score; });
  const double speed = best.line.velocity.norm();
  if (speed < config.slowest || speed > config.fastest) return std::nullopt;
  if (!seen_throughout(best, score, frames, dt, config)) return std::nullopt;
  return best.line;
}

}  // namespace walktrack
