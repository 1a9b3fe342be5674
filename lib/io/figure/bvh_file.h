// figure.bvh: the moving figure for Blender, MotionBuilder and other programs that read Biovision
// Hierarchy (Meredith & Maddock, "Motion Capture File Formats Explained", Univ. of Sheffield
// CS-01-11, 2001).
//
// Axes are OpenSim's (body/joint_angles.h): x as in the world, y up, z to the right of x; metres.
// Blender's importer turns them into the world's again. The pelvis has six channels, every other
// joint the three of its rotation, R = Rz Rx Ry in degrees; toes, head and wrists are end sites.
//
// BVH cannot represent changing lengths or missing frames. Tracked and measured bones change their
// lengths by centimetres; here they have their mean lengths, and the knee is flexed slightly more
// or less so that the ankle keeps its position if the leg is long enough. A frame without a pose
// repeats the one before it; the first frames repeat the first known one.
#pragma once

#include <string>

#include "io/figure/animated_figure.h"

namespace walktrack {
inline namespace io {

// One frame for each row, at `rate` Hz. "" if no frame has a pose.
std::string bvh_from_figure(const AnimatedFigure& figure, double rate);

}  // namespace io
}  // namespace walktrack
