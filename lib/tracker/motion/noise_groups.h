// Noise that moves one part of a body and is therefore changed together.
#pragma once

#include <array>

#include "tracker/motion/particle.h"

namespace walktrack {

inline constexpr int noise_of(ResidualAngle residual) { return int{kExtraNoise} + int{residual}; }

inline constexpr std::array kTrunkNoise{int{kBallNoise}, kBallNoise + 1,    noise_of(kHeading),
                                        noise_of(kList), noise_of(kCrouch), noise_of(kTilt)};
inline constexpr std::array kLeftLegNoise{noise_of(kAbduction), noise_of(kRotation),
                                          noise_of(kAnkle), noise_of(kThigh), noise_of(kShank)};
inline constexpr std::array kRightLegNoise{noise_of(kAbductionRight), noise_of(kRotationRight),
                                           noise_of(kAnkleRight), noise_of(kThighRight),
                                           noise_of(kShankRight)};
// What a walker feels.
inline constexpr std::array kWalkerNoise{int{kTorqueNoise}, kTorqueNoise + 1, kTorqueNoise + 2,
                                         kTorqueNoise + 3,  kTorqueNoise + 4, noise_of(kPace)};
inline constexpr std::array kLeftArmNoise{noise_of(kShoulder), noise_of(kShoulderAbduction),
                                          noise_of(kElbow)};
inline constexpr std::array kRightArmNoise{
    noise_of(kShoulderRight), noise_of(kShoulderAbductionRight), noise_of(kElbowRight)};

// The same on a sagittal path.
inline constexpr std::array kTrunkInPlane{int{kBallNoise}, kBallNoise + 1, noise_of(kCrouch),
                                          noise_of(kTilt)};
inline constexpr std::array kLeftLegInPlane{noise_of(kAnkle), noise_of(kThigh), noise_of(kShank)};
inline constexpr std::array kRightLegInPlane{noise_of(kAnkleRight), noise_of(kThighRight),
                                             noise_of(kShankRight)};
inline constexpr std::array kLeftArmInPlane{noise_of(kShoulder), noise_of(kElbow)};
inline constexpr std::array kRightArmInPlane{noise_of(kShoulderRight), noise_of(kElbowRight)};

}  // namespace walktrack
