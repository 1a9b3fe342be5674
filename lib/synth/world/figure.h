// A walker for the renderer: joint centres over time, with the parts of a body.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "body/body.h"
#include "body/kinematics.h"
#include "body/motion.h"
#include "synth/world/material.h"

namespace walktrack {
inline namespace synth {

// One material for each appearance class of body/body.h.
using Clothes = std::array<Material, kAppearanceCount>;

// Several sets of clothes that differ from each other and from the settings; any index is valid.
Clothes clothes(int index);

// A body of this stature with the median lengths of the motion's bones, and with arms if the motion
// has them. Throws InputError if no row has both legs.
Body body_from_motion(const Motion& motion, double height);

// The segments' orientations from joint centres: bones pass through their joints exactly, the hinge
// axis of a leg or arm is common to its two bones, and the trunk's left axis is between those of
// hips and shoulders. nullopt if a hip, knee or ankle is unknown, or if the body has arms and one
// of their joints is unknown. Without toes the feet are flat and point in the direction of the
// pelvis; without a neck the trunk is upright.
std::optional<Skeleton> skeleton_from_joints(const Body& body, const JointPositions& joints);

}  // namespace synth
}  // namespace walktrack
