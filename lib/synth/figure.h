// A walker as the renderer sees it: joint centres over time, dressed in the parts of a body.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "body/body.h"
#include "body/kinematics.h"
#include "body/motion.h"
#include "synth/material.h"

namespace walktrack {
inline namespace synth {

// One material for each class of body/body.h.
using Clothes = std::array<Material, kAppearanceCount>;

// A few sets of clothes that differ from each other and from the settings; any index is valid.
Clothes clothes(int index);

// A body of this stature whose bones have the median lengths of the motion, with arms if the motion
// knows them. Throws InputError if no row knows both legs.
Body body_from_motion(const Motion& motion, double height);

// The segments' orientations from joint centres: bones run through their joints exactly, a leg's
// and an arm's hinge axis is common to its two bones, the trunk's left lies between hips' and
// shoulders'. nullopt if a hip, knee or ankle is unknown, or if the body has arms and a joint of
// theirs is. Without toes the feet are flat and point where the pelvis does; without a neck the
// trunk is upright.
std::optional<Skeleton> skeleton_from_joints(const Body& body, const JointPositions& joints);

}  // namespace synth
}  // namespace walktrack
