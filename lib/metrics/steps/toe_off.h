// When a foot leaves the ground, read from the speed of its toe.
//
// By definition a foot leaves the ground when its toe is furthest behind the pelvis (Zeni, Richards
// & Higginson, Gait & Posture 27, 2008), that is when the toe has the pelvis's speed. A toe gains
// speed slowly at first and faster afterwards, so that the smoothing of a track makes this moment
// 16 ms too early. Half of the swing's highest speed, however, is reached at the same time with and
// without smoothing, and how much earlier the toe had the pelvis's speed follows from the ratio of
// both speeds:
//   toe-off = t(half) - kRiseTime (kHalfSpeed - pelvis / highest),
// least squares over 23 motion-captured walks (reports/toe_off.md). Metres, seconds.
#pragma once

#include <optional>
#include <span>

namespace walktrack {
inline namespace metrics {

inline constexpr double kRiseTime = 0.31;   // s
inline constexpr double kHalfSpeed = 0.38;  // of the highest speed

// `speed`: of the toe along the direction of walking, m/s, by row; `turn`: the row in which the toe
// is furthest behind the pelvis, whose speed then is `pelvis`. Nothing if the rows end before the
// swing's highest speed.
std::optional<double> toe_off_time(std::span<const double> time, std::span<const double> speed,
                                   size_t turn, double pelvis);

}  // namespace metrics
}  // namespace walktrack
