#include "tracker/walk_prior.h"

#include <algorithm>
#include <cmath>

namespace walktrack {
inline namespace tracker {

namespace {

constexpr double kHalfWindow = 0.5;  // s
// A slower subject stands, m/s. By hand: half of the slowest patient's speed.
constexpr double kSlowest = 0.3;

// Shares of the stature.
struct Aside {
  double mean, sd;
};
constexpr Aside kKneeAside{.044, .020}, kAnkleAside{.022, .026};

}  // namespace

WalkingDirection walking_direction(const Eigen::Vector2d& velocity) {
  if (velocity.norm() <= kSlowest) return std::nullopt;
  return velocity.normalized();
}

std::vector<WalkingDirection> walking_directions(std::span<const Eigen::Vector2d> places,
                                                 double dt) {
  std::vector<WalkingDirection> out(places.size());
  const auto half = static_cast<size_t>(std::lround(kHalfWindow / dt));
  for (size_t t = 0; t < places.size(); ++t) {
    const size_t before = t - std::min(t, half), after = std::min(t + half, places.size() - 1);
    if (after > before)
      out[t] = walking_direction((places[after] - places[before]) /
                                 (dt * static_cast<double>(after - before)));
  }
  return out;
}

LegsAside legs_aside(const JointPositions& joints, double stature, const Eigen::Vector2d& ahead) {
  const Eigen::Vector2d left(-ahead.y(), ahead.x());
  const auto off = [&](Joint joint, Side side, const Aside& usual) {
    const double to_left = left.dot((joints[joint] - joints[Joint::kPelvis]).head<2>());
    const double aside = (side == Side::kLeft ? to_left : -to_left) / stature;
    return (aside - usual.mean) / usual.sd;
  };
  return {off(Joint::kLeftKnee, Side::kLeft, kKneeAside),
          off(Joint::kRightKnee, Side::kRight, kKneeAside),
          off(Joint::kLeftAnkle, Side::kLeft, kAnkleAside),
          off(Joint::kRightAnkle, Side::kRight, kAnkleAside)};
}

}  // namespace tracker
}  // namespace walktrack
