#include "observation/flow/leg_order.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "observation/flow/frame_pair_points.h"

namespace walktrack {
inline namespace observation {

namespace {

using Eigen::Vector2d;

// By hand; sensitivity not measured.
constexpr double kInnerRadius = 0.85;  // share of a leg's width that certainly shows the leg
constexpr double kBelowHands = 0.4;    // share of the thigh, from the knee
// Differences are limited to three standard deviations, because larger ones are due to shoes, hems
// or the edge of a shadow. By hand.
constexpr double kWorst = 9;
constexpr double kDof = 3;  // of the Student-t

std::optional<Side> leg_of(Segment segment) {
  switch (segment) {
    case Segment::kLeftThigh:
    case Segment::kLeftShank:
    case Segment::kLeftFoot:
      return Side::kLeft;
    case Segment::kRightThigh:
    case Segment::kRightShank:
    case Segment::kRightFoot:
      return Side::kRight;
    default:
      return {};
  }
}

bool is_thigh(Segment segment) {
  return segment == Segment::kLeftThigh || segment == Segment::kRightThigh;
}

// A part of one leg in front of a part of the other one: indices in the list of capsules.
struct Crossing {
  size_t near, far;
  PixelRect area;
};

PixelRect pixels_in_both(const Box& a, const Box& b) {
  const Vector2d low = a.low.cwiseMax(b.low), high = a.high.cwiseMin(b.high);
  return {static_cast<int>(std::ceil(low.x())), static_cast<int>(std::ceil(low.y())),
          static_cast<int>(std::floor(high.x())) + 1, static_cast<int>(std::floor(high.y())) + 1};
}

std::vector<Crossing> crossings(std::span<const Part> parts, const CapsuleList& now) {
  const auto side = [&](size_t i) { return leg_of(parts[size_t(now[i].part)].segment); };
  const auto box = [&](size_t i) { return box_of(shape_of(now[i], kInnerRadius)); };
  std::vector<Crossing> out;
  for (size_t near = 0; near < now.size(); ++near) {
    for (size_t far = near + 1; side(near) && far < now.size(); ++far) {
      if (!side(far) || side(far) == side(near)) continue;
      const PixelRect area = pixels_in_both(box(near), box(far));
      if (!area.empty()) out.push_back({near, far, area});
    }
  }
  return out;
}

// One leg's part, now and before.
struct SeenLimb {
  Shape inner, now, before;
  Appearance appearance;
  bool thigh;

  bool shows(const Vector2d& point) const {
    return covers(inner, point) && !(thigh && material_point(now, point).along > kBelowHands);
  }
  // Position of a point of the part in the previous frame.
  Vector2d origin(const Vector2d& point) const {
    return pixel_of(before, material_point(now, point));
  }
};

bool looks_like(const SeenLimb& limb, const LogRatioPlanes& planes, const Vector2d& point) {
  return log_ratio_at(planes, limb.appearance, static_cast<int>(std::lround(point.x())),
                      static_cast<int>(std::lround(point.y()))) > 0;
}

// Logarithm of the Student-t factor for the assumption that a point comes from there.
std::optional<double> strangeness(const FramePair& pair, const Vector2d& is, const Vector2d& was) {
  const auto here = between(pair, is), there = between(pair, was);
  if (!here || !there) return {};
  const double residual = static_cast<double>(here->mix(&PairPixel::now)) -
                          static_cast<double>(there->mix(&PairPixel::before));
  const double precision = static_cast<double>(here->precision());
  return 0.5 * (kDof + 1) * std::log(kDof + std::min(kWorst, precision * residual * residual));
}

struct Asked {
  const FramePair& pair;
  const SeenLegs& before;
  const SeenLegs& now;
};

double point_log_ratio(const Asked& asked, const SeenLimb& near, const SeenLimb& far,
                       const Vector2d& point) {
  const Vector2d from_near = near.origin(point), from_far = far.origin(point);
  if (!looks_like(near, asked.now.planes, point) ||
      !looks_like(near, asked.before.planes, from_near) ||
      !looks_like(far, asked.before.planes, from_far))
    return 0;
  const auto as_near = strangeness(asked.pair, point, from_near);
  const auto as_far = strangeness(asked.pair, point, from_far);
  return as_near && as_far ? *as_far - *as_near : 0;
}

// The capsules that may be in front of a crossing.
std::vector<Shape> hiders(const CapsuleList& capsules, const Crossing& crossing) {
  const PixelRect& area = crossing.area;
  const Box box{{area.x0, area.y0}, {area.x1, area.y1}};
  std::vector<Shape> out;
  for (size_t i = 0; i < crossing.near; ++i) {
    const Shape shape = shape_of(capsules[i]);
    if (meet(box_of(shape), box)) out.push_back(shape);
  }
  return out;
}

double crossing_log_ratio(const Asked& asked, const Crossing& crossing, const SeenLimb& near,
                          const SeenLimb& far) {
  const std::vector<Shape> in_front = hiders(asked.now.capsules, crossing);
  double sum = 0;
  for (int y = crossing.area.y0; y < crossing.area.y1; ++y) {
    for (int x = crossing.area.x0; x < crossing.area.x1; ++x) {
      const Vector2d point(x, y);
      if (!near.shows(point) || !far.shows(point)) continue;
      const auto hides = [&](const Shape& shape) { return covers(shape, point); };
      if (std::none_of(in_front.begin(), in_front.end(), hides))
        sum += point_log_ratio(asked, near, far, point);
    }
  }
  return sum;
}

}  // namespace

PixelRect leg_overlap(std::span<const Part> parts, const CapsuleList& now) {
  PixelRect all;
  for (const Crossing& each : crossings(parts, now)) {
    const PixelRect& area = each.area;
    if (all.empty()) all = area;
    all = {std::min(all.x0, area.x0), std::min(all.y0, area.y0), std::max(all.x1, area.x1),
           std::max(all.y1, area.y1)};
  }
  return all;
}

double leg_order_log_ratio(std::span<const Part> parts, const FramePair& pair,
                           const SeenLegs& before, const SeenLegs& now) {
  if (pair.pixels.empty()) return 0;
  std::array<const Capsule*, kMaxCapsules> earlier{};
  for (const Capsule& capsule : before.capsules)
    earlier[static_cast<size_t>(capsule.part)] = &capsule;
  const auto limb = [&](size_t i) -> std::optional<SeenLimb> {
    const Capsule& capsule = now.capsules[i];
    const auto part = static_cast<size_t>(capsule.part);
    if (!earlier[part]) return {};
    return SeenLimb{shape_of(capsule, kInnerRadius), shape_of(capsule), shape_of(*earlier[part]),
                    capsule.appearance, is_thigh(parts[part].segment)};
  };
  double sum = 0;
  for (const Crossing& crossing : crossings(parts, now.capsules)) {
    const auto near = limb(crossing.near), far = limb(crossing.far);
    if (near && far) sum += crossing_log_ratio({pair, before, now}, crossing, *near, *far);
  }
  return sum;
}

}  // namespace observation
}  // namespace walktrack
