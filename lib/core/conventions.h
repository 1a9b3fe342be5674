// The conventions of the whole library.
//
// World (right-handed, metres, seconds, kilograms, radians), ground plane z = 0, z up. Calibration
// files may use other axes, which are converted on reading and on writing.
//
//        z up                     Body frame of a part: x forward, y left, z up along the part.
//        |   y left
//        |  /                     Planar angles turn about the left-pointing y axis, so a positive
//        | /                      angle leans the upper end of a part forward:
//        o------ x forward          u(a) = ( sin a, cos a)  up the part         (x, z components)
//                                   w(a) = ( cos a, -sin a) forward of the part
//
// Walking forward has positive rates. Knee flexion = shank angle - thigh angle >= 0. Hip flexion =
// torso angle - thigh angle. A slope tilts gravity, not the ground: g (sin s, -cos s), where s > 0
// is downhill.
//
// Transforms are named target_from_source (x_camera = camera_from_world * x_world). Other units
// than SI are in the name: _deg, _mm, _px, _ms.
#pragma once

#include <limits>
#include <numbers>

namespace walktrack {
inline namespace core {

inline constexpr double kPi = std::numbers::pi;
inline constexpr double kStandardGravity = 9.80665;  // m/s^2
inline constexpr double kMetresPerMillimetre = 1e-3;

// Bands reach from 5 to 95 %: for a normal distribution, so many standard deviations to either
// side.
inline constexpr double kBandQuantile = 1.645;

// Stands for an unknown number: an empty cell of a table, a joint that was not tracked.
inline constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

inline constexpr double deg_from_rad(double angle) { return angle * (180.0 / kPi); }
inline constexpr double rad_from_deg(double angle_deg) { return angle_deg * (kPi / 180.0); }

}  // namespace core
}  // namespace walktrack
