// figure.bvh: the moving figure for Blender, MotionBuilder and whatever else reads Biovision
// Hierarchy (Meredith & Maddock, "Motion Capture File Formats Explained", Univ. of Sheffield
// CS-01-11, 2001).
//
// Axes are OpenSim's (body/joint_angles.h): x as in the world, y up, z to the right of x; metres.
// Blender's importer turns them into the world's again. The pelvis has six channels, every other
// joint the three of its rotation, R = Rz Rx Ry in degrees; toes, head and wrists are end sites.
//
// What BVH cannot say: a length that changes, and that nobody was seen. Tracked and measured bones
// change theirs by centimetres; here they have their mean ones, and a knee bends a little more or
// less so that the ankle is where it was, if the leg is long enough. A frame without a pose repeats
// the one before it, the first ones the first that is known.
#pragma once

#include <string>

#include "io/figure/animated_figure.h"

namespace walktrack {
inline namespace io {

// One frame for each row, at `rate` Hz. "" if no frame has a pose.
std::string bvh_from_figure(const AnimatedFigure& figure, double rate);

}  // namespace io
}  // namespace walktrack
