// Time between the frames of the tracker's tests.
#pragma once

namespace walktrack {

inline constexpr double kDt = 1.0 / 30;  // s

}  // namespace walktrack
