// figure.glb: the moving figure as binary glTF 2.0 (Khronos, ISO/IEC 12113:2022) for Blender, game
// engines and viewers in browsers.
//
// Axes are OpenSim's (body/joint_angles.h), y up, metres; Blender's importer converts them to the
// world's. Joints are nodes with the names of joints.csv; a skin with one joint for each vertex
// contains the body's solid parts, left blue, right red. The animation "walk" has a key for each
// frame with a pose: the pelvis's position, rotations, and offsets of joints whose distance from
// their parent changes by more than kSteadyLength. While nobody is tracked the figure has the scale
// 0.
#pragma once

#include <string>

#include "body/subject.h"
#include "io/figure/animated_figure.h"

namespace walktrack {
inline namespace io {

inline constexpr double kSteadyLength = 1e-4;  // m

// "" if no frame has a pose. A key whose time equals the previous one after rounding to float is
// left out.
std::string glb_from_figure(const AnimatedFigure& figure, const Subject& subject);

}  // namespace io
}  // namespace walktrack
