// The same walk with the legs swapped: the left leg moves like the right one before, half a stride
// away, and each foot stays where a foot was. Arms swing opposite to the legs and are swapped with
// them. The pelvis does not move, so that each leg begins at the other hip and reaches its foot
// with another abduction. Seen from the side nothing changes: the two are modes of one posterior
// (tracker/modes/stride_modes.h), and this is the involution that maps one to the other.
#pragma once

#include <span>

#include "tracker/motion/propagate.h"
#include "tracker/walker_filter.h"

namespace walktrack {
inline namespace tracker {

Pose mirrored_legs(const Body& body, const Pose& pose);

// Names every joint below hips and shoulders for the other side.
void swap_legs(JointPositions& joints);

// Swaps the particle's state now and a frame ago, and the frame's noise, which has to be applied
// already.
void mirror_legs(const MotionContext& context, WalkerParticle& particle);

// Swaps all particles of the filter.
void mirror_legs(const MotionContext& context, WalkerFilter& filter);

// Swaps the estimate of a frame, its samples, and its phase in the stride.
void mirror_legs(const Body& body, FrameRecord& record);

// If the newest record is half a stride away from the one before it, swaps the legs of the records
// before it, as far back as the subject walks: the newest particles have explained more frames, and
// who stands has no phase. Returns whether it is more than a quarter of a stride away, so that it
// may be one or the other.
bool relabel_before_switch(const Body& body, std::span<FrameRecord> records);

}  // namespace tracker
}  // namespace walktrack
