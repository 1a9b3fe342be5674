#include "tracker/detect/keypoint_lines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <Eigen/Cholesky>

namespace walktrack {
inline namespace tracker {

namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

// Heights of joints that stay where they are in walking, shares of the body's (Drillis & Contini
// 1966; the ankles' mean over a stride).
constexpr double kShoulderHeight = 0.80, kHipHeight = 0.52, kAnkleHeight = 0.06;
// By hand: with a worse fit, as a share of the height in the image, no person stands there.
constexpr double kFits = 0.1;
constexpr int kSteps = 8;  // of Gauss and Newton
// By hand: a person who walks does not move further.
constexpr double kMostSpeed = 4, kJump = 0.5;  // m/s, m: between one frame's place and the next

constexpr size_t index(PointKind kind) { return 2 * static_cast<size_t>(kind) - 1; }

// The middle of a left and a right point; nullopt if neither was seen.
std::optional<Vector2d> middle(const KeypointEvidence::Person& person, PointKind kind) {
  const auto &left = person[index(kind)], &right = person[index(kind) + 1];
  if (left.precision == 0 && right.precision == 0) return std::nullopt;
  if (left.precision == 0) return right.px;
  if (right.precision == 0) return left.px;
  return 0.5 * (left.px + right.px);
}

struct Level {
  double height;  // above the ground, m
  Vector2d px;
};

std::vector<Level> levels_of(const KeypointEvidence::Person& person, double height) {
  std::vector<Level> out;
  for (const auto& [kind, share] :
       {std::pair{PointKind::kShoulder, kShoulderHeight}, std::pair{PointKind::kHip, kHipHeight},
        std::pair{PointKind::kAnkle, kAnkleHeight}})
    if (const auto px = middle(person, kind)) out.push_back({share * height, *px});
  return out;
}

// Where the lowest level's ray reaches its height.
std::optional<Vector2d> first_place(const Level& level, const Camera& camera) {
  const auto ray = unproject(camera, level.px);
  if (!ray || ray->direction.z() >= -1e-3) return std::nullopt;
  const double along = (level.height - ray->origin.z()) / ray->direction.z();
  if (!(along > 0)) return std::nullopt;
  return (ray->origin + along * ray->direction).head<2>();
}

// Gauss and Newton's step; the sum of squares, px^2, goes to `error`.
std::optional<Vector2d> improved(const Vector2d& place, const std::vector<Level>& levels,
                                 const Camera& camera, double& error) {
  Matrix2d normal = Matrix2d::Zero();
  Vector2d pull = Vector2d::Zero();
  error = 0;
  for (const Level& level : levels) {
    const auto seen = project_with_jacobian(camera, {place.x(), place.y(), level.height});
    if (!seen) return std::nullopt;
    const Matrix2d moved = seen->d_pixel_d_point.leftCols<2>();
    const Vector2d residual = level.px - seen->pixel;
    normal += moved.transpose() * moved;
    pull += moved.transpose() * residual;
    error += residual.squaredNorm();
  }
  const Vector2d step = normal.ldlt().solve(pull);
  if (!step.allFinite()) return std::nullopt;
  return Vector2d(place + step);
}

struct Sight {
  double time;
  Vector2d place;
};
using Track = std::vector<Sight>;

Track* nearest(std::vector<Track>& tracks, const Sight& sight) {
  Track* best = nullptr;
  double least = 0;
  for (Track& track : tracks) {
    const double gap = sight.time - track.back().time;
    const double apart = (sight.place - track.back().place).norm();
    if (gap <= 0 || apart > kJump + kMostSpeed * gap || (best && apart >= least)) continue;
    best = &track;
    least = apart;
  }
  return best;
}

double median(std::vector<double>& values) {
  const auto at = values.begin() + static_cast<long>(values.size() / 2);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

Vector2d median(const std::vector<Vector2d>& values) {
  Vector2d out;
  for (Eigen::Index axis = 0; axis < 2; ++axis) {
    std::vector<double> numbers;
    for (const Vector2d& value : values) numbers.push_back(value[axis]);
    out[axis] = median(numbers);
  }
  return out;
}

// Pairs that are closer in time than a third of the track hardly determine the velocity.
KeypointLine line_through(const Track& track) {
  const double apart = (track.back().time - track.front().time) / 3;
  std::vector<Vector2d> velocities, places;
  for (size_t i = 0; i < track.size(); ++i)
    for (size_t j = i + 1; j < track.size(); ++j)
      if (track[j].time - track[i].time >= apart)
        velocities.push_back((track[j].place - track[i].place) / (track[j].time - track[i].time));
  const Vector2d velocity = median(velocities);
  for (const Sight& sight : track) places.push_back(sight.place - sight.time * velocity);
  return {median(places), velocity, static_cast<int>(track.size())};
}

}  // namespace

std::optional<Vector2d> place_of(const KeypointEvidence::Person& person, const Camera& camera,
                                 double height) {
  const std::vector<Level> levels = levels_of(person, height);
  if (levels.size() < 2 || !middle(person, PointKind::kAnkle)) return std::nullopt;
  std::optional<Vector2d> place = first_place(levels.back(), camera);
  double error = 0;
  for (int i = 0; i < kSteps && place; ++i) place = improved(*place, levels, camera, error);
  if (!place || !improved(*place, levels, camera, error)) return std::nullopt;
  const double metres = levels.front().height - levels.back().height;
  const double seen_px = (levels.front().px - levels.back().px).norm();
  const double height_px = seen_px * height / metres;
  if (std::sqrt(error / double(levels.size())) > kFits * height_px) return std::nullopt;
  return place;
}

std::vector<KeypointLine> keypoint_lines(std::span<const KeypointEvidence* const> frames,
                                         const Camera& camera, double height, double dt,
                                         double least_seconds) {
  std::vector<Track> tracks;
  for (size_t i = 0; i < frames.size(); ++i) {
    for (const KeypointEvidence::Person& person : frames[i]->people) {
      const auto place = place_of(person, camera, height);
      if (!place) continue;
      const Sight sight{double(i) * dt, *place};
      if (Track* const track = nearest(tracks, sight)) {
        track->push_back(sight);
      } else {
        tracks.push_back({sight});
      }
    }
  }
  std::vector<KeypointLine> out;
  for (const Track& track : tracks)
    if (track.size() > 2 && track.back().time - track.front().time >= least_seconds)
      out.push_back(line_through(track));
  std::stable_sort(out.begin(), out.end(), [](const KeypointLine& a, const KeypointLine& b) {
    return a.frames > b.frames;
  });
  return out;
}

}  // namespace tracker
}  // namespace walktrack
