#include "kinetics/ground_contact.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace walktrack {
inline namespace kinetics {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kLeastLoad = 1;  // N; below it a centre of pressure is undefined

// The leading foot's share of the load at the share `x` of double support: half way between a
// straight line and the smooth step, as force plates measure it (tests/jobs/force_plates_test.cpp).
double leading_share(double x) { return 0.5 * (x + x * x * (3 - 2 * x)); }

const FootContact* standing(std::span<const FootContact> contacts, Side side, double t) {
  for (const FootContact& each : contacts)
    if (each.side == side && each.on <= t && t <= each.off) return &each;
  return nullptr;
}

LoadShares all_on(Side side) {
  LoadShares out{{0, 0}, side};
  out.of[static_cast<size_t>(side)] = 1;
  return out;
}

// The point within a sole that is nearest to `centre`. Heel and tip are .47 and .57 of the distance
// between ankle and ball behind the ankle and in front of the ball (body/subject.cpp: ankle at 23
// %, ball at 72 % of the foot). Half the width of a sole, m, is set by hand.
Vector2d within_sole(const FootPlace& place, const Vector2d& centre) {
  constexpr double kBehind = .47, kAhead = 1.57, kHalfWidth = .05;
  const Vector2d bone = place.ball - place.ankle;
  const double length = bone.norm();
  if (length == 0) return place.ankle;
  const Vector2d forward = bone / length, left(-forward.y(), forward.x());
  const Vector2d from = centre - place.ankle;
  return place.ankle + forward * std::clamp(forward.dot(from), -kBehind * length, kAhead * length) +
         left * std::clamp(left.dot(from), -kHalfWidth, kHalfWidth);
}

// The trailing foot is on its ball, the leading one lands near its ankle; a single supporting foot
// is shifted to the centre of pressure of the whole.
std::array<Vector2d, 2> centres_to_start_from(Side leading,
                                              const std::array<FootPlace, 2>& places) {
  if (leading == Side::kLeft) return {places[0].ankle, places[1].ball};
  return {places[0].ball, places[1].ankle};
}

Vector3d on_ground(const Vector2d& point) { return {point.x(), point.y(), 0}; }

}  // namespace

std::optional<LoadShares> load_shares(std::span<const FootContact> contacts, double t) {
  const FootContact* left = standing(contacts, Side::kLeft, t);
  const FootContact* right = standing(contacts, Side::kRight, t);
  if (left && right) {
    const double begin = std::max(left->on, right->on), end = std::min(left->off, right->off);
    const double lead = end > begin ? leading_share((t - begin) / (end - begin)) : 1;
    if (left->on > right->on) return LoadShares{{lead, 1 - lead}, Side::kLeft};
    return LoadShares{{1 - lead, lead}, Side::kRight};
  }
  if (left || right) return all_on(left ? Side::kLeft : Side::kRight);
  double nearest = kShortestFlight / 2;
  std::optional<LoadShares> out;
  for (const FootContact& each : contacts) {
    const double apart = std::max(each.on - t, t - each.off);
    if (apart >= nearest) continue;
    nearest = apart;
    out = all_on(each.side);
  }
  return out;
}

Wrench sum_of(const std::array<FootLoad, 2>& feet) {
  Wrench out;
  for (const FootLoad& foot : feet) {
    if (!foot.centre.allFinite()) continue;
    out.force += foot.force;
    out.moment += on_ground(foot.centre).cross(foot.force) + Vector3d(0, 0, foot.free_moment);
  }
  return out;
}

GroundLoads shared_loads(const Wrench& whole, const LoadShares& shares,
                         const std::array<FootPlace, 2>& places, const Vector3d& com) {
  GroundLoads out;
  if (whole.force.z() < kLeastLoad) return out;
  const std::array<Vector2d, 2> start = centres_to_start_from(shares.leading, places);
  // moment = p x force + (0, 0, free), so p = (-moment_y, moment_x) / force_z on the ground.
  const Vector2d whole_centre = Vector2d(-whole.moment.y(), whole.moment.x()) / whole.force.z();
  const Vector2d shift = whole_centre - shares.of[0] * start[0] - shares.of[1] * start[1];
  Vector2d missing = whole.force.head<2>();
  for (size_t side = 0; side < 2; ++side) {
    if (shares.of[side] <= 0) continue;
    FootLoad& foot = out.feet[side];
    foot.centre = within_sole(places[side], start[side] + shift);
    foot.force.z() = shares.of[side] * whole.force.z();
    foot.force.head<2>() = foot.force.z() / com.z() * (com.head<2>() - foot.centre);
    missing -= foot.force.head<2>();
  }
  for (size_t side = 0; side < 2; ++side)
    out.feet[side].force.head<2>() += shares.of[side] * missing;
  const Vector3d left_over = whole.moment - sum_of(out.feet).moment;
  for (size_t side = 0; side < 2; ++side)
    out.feet[side].free_moment = shares.of[side] * left_over.z();
  out.unexplained = left_over.head<2>().norm();
  return out;
}

}  // namespace kinetics
}  // namespace walktrack
