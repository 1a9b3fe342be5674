#include "synth/walk/foot_path.h"

#include <algorithm>
#include <cmath>

namespace walktrack {
inline namespace synth {

namespace {

// Shares of the foot's length: the heel behind the ankle, the tip of the toes in front of the ball
// (body/subject.cpp).
constexpr double kHeelBack = .23, kTipAhead = .28;
constexpr double kStretched = .26;  // share of the swing after which toes are straight; by hand
constexpr double kLifting = .40;    // share of the swing for lifting, and for lowering; by hand
// Smoothing length where the lowest point changes from tip to heel, share of the foot: 4 cm for a
// usual one; by hand.
constexpr double kRounding = .04 / .266;

}  // namespace

double smooth_step(double s) {
  s = std::clamp(s, 0.0, 1.0);
  return s * s * s * (10 - 15 * s + 6 * s * s);
}

Eigen::Vector2d rolled_ankle(const BodyLengths& lengths, double pitch) {
  const double c = std::cos(pitch), s = std::sin(pitch);
  const double pivot = pitch < 0 ? -kHeelBack * lengths.foot : lengths.ball_forward;
  return {pivot * (1 - c) + lengths.ankle_height * s, lengths.ankle_height * c + pivot * s};
}

double swinging_ankle(const BodyLengths& lengths, double pitch, double swing, double clearance) {
  const double toes = kTipAhead * lengths.foot * smooth_step(swing / kStretched);
  const double tip = lengths.ball_forward * std::sin(pitch) + toes * std::sin(pitch);
  const double heel = -kHeelBack * lengths.foot * std::sin(pitch);
  const double lifted = smooth_step(swing / kLifting) * smooth_step((1 - swing) / kLifting);
  // A smooth maximum of both.
  const double below =
      0.5 * (tip + heel + std::hypot(tip - heel, kRounding * lengths.foot * lifted));
  return lengths.ankle_height * std::cos(pitch) + below + clearance * lifted;
}

Eigen::Vector2d swing_path(const PathEnd& from, const PathEnd& to, double swing) {
  const double s = swing, s2 = s * s, s3 = s2 * s, s4 = s3 * s, s5 = s4 * s;
  return from.place * (1 - 10 * s3 + 15 * s4 - 6 * s5) +
         from.velocity * (s - 6 * s3 + 8 * s4 - 3 * s5) +
         from.acceleration * (0.5 * s2 - 1.5 * s3 + 1.5 * s4 - 0.5 * s5) +
         to.place * (10 * s3 - 15 * s4 + 6 * s5) + to.velocity * (-4 * s3 + 7 * s4 - 3 * s5) +
         to.acceleration * (0.5 * s3 - s4 + 0.5 * s5);
}

}  // namespace synth
}  // namespace walktrack
