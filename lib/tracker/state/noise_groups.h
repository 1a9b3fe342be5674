// Noise that moves one part of a body and is therefore changed together.
#pragma once

#include <array>
#include <span>

#include "tracker/motion/motion_model.h"
#include "tracker/state/particle.h"

namespace walktrack {
inline namespace tracker {

constexpr int noise_of(ResidualAngle residual) { return int{kResidualNoise} + int{residual}; }

// Indices of WalkerParticle::noise.
struct NoiseIndices {
  std::array<int, 8> at{};
  size_t count = 0;

  constexpr void add(int index) { at[count++] = index; }
  constexpr operator NoiseGroup() const { return {at.data(), count}; }
};

// The residual angles that move the same part on one side and have a process on this path.
constexpr NoiseIndices noise_that(Moves moves, Side side, Path path) {
  NoiseIndices out;
  if (moves == Moves::kTrunk)
    for (const int along : {0, 1}) out.add(kBallNoise + along);
  if (moves == Moves::kWalker)
    for (int torque = kTorqueNoise; torque < kBallNoise; ++torque) out.add(torque);
  for (const ResidualRow& row : kResidualTable)
    if (row.moves == moves && is_free(row, path, true)) out.add(noise_of(row.of(side)));
  return out;
}

// The noise that acts on the walker.
inline constexpr NoiseIndices kWalkerNoise =
    noise_that(Moves::kWalker, Side::kLeft, Path::kSpatial);

struct BodyNoise {
  NoiseIndices trunk, left_leg, right_leg, left_arm, right_arm;
};
constexpr BodyNoise body_noise(Path path) {
  return {noise_that(Moves::kTrunk, Side::kLeft, path), noise_that(Moves::kLeg, Side::kLeft, path),
          noise_that(Moves::kLeg, Side::kRight, path), noise_that(Moves::kArm, Side::kLeft, path),
          noise_that(Moves::kArm, Side::kRight, path)};
}
inline constexpr BodyNoise kSpatialNoise = body_noise(Path::kSpatial),
                           kSagittalNoise = body_noise(Path::kSagittal);

// The body's groups, and one of the walker before the arms, which come last.
constexpr std::array<NoiseGroup, 6> groups_with(const BodyNoise& body, NoiseGroup walker) {
  return {body.trunk, body.left_leg, body.right_leg, walker, body.left_arm, body.right_arm};
}

}  // namespace tracker
}  // namespace walktrack
