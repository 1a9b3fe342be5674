// The same walk with the legs swapped: the left leg does what the right one did, half a stride
// away, and each foot stays where a foot was. Arms swing against the legs and are swapped with
// them; the pelvis stays as it is, so each leg now starts from the other hip and reaches its place
// by another abduction. Seen from the side nothing changes: the two are modes of one posterior
// (tracker/modes/stride_modes.h), and this is the involution that takes one to the other.
#pragma once

#include "tracker/motion/propagate.h"
#include "tracker/walker_filter.h"

namespace walktrack {
inline namespace tracker {

Pose mirrored_legs(const Body& body, const Pose& pose);

// Now and a frame ago, with the frame's noise; the particle is realised.
void mirror_legs(const MotionContext& context, WalkerParticle& particle);

// All of them.
void mirror_legs(const MotionContext& context, WalkerFilter& filter);

// What was estimated of a frame, its samples, and its place in the stride.
void mirror_legs(const Body& body, FrameRecord& record);

}  // namespace tracker
}  // namespace walktrack
