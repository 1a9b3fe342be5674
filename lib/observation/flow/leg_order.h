// Which leg is in front. Where the legs overlap in an image the nearer one is seen, and its pixels
// move with it: one leg swings, the other is on the ground. For a pixel u that both legs cover in a
// pose, the nearer leg's point was at n in the previous frame and the farther one's at f. With the
// grey images I (now) and J (before),
//   log ratio = (dof + 1)/2 [ log(dof + (I(u) - J(f))^2 / s^2) - log(dof + (I(u) - J(n))^2 / s^2) ]
// is the evidence for the pose's order of the legs, where s^2 is the variance of a difference
// (frame_pair.h) and squares over s^2 are at most 9. Both orders have the same outline, so that
// this term distinguishes left from right where silhouettes from the side cannot.
//
// Only pixels well inside both legs are used that nothing else hides and that are below the
// swinging hands: an arm, which the body may not have, swings with the leg that is farther away and
// would be evidence for the wrong order. A pixel that looks like the empty scene, now or at the
// position from which it would come, shows no leg and gives no evidence, and neither does cloth
// without texture or shading.
#pragma once

#include <span>

#include "observation/flow/frame_pair.h"
#include "observation/silhouette/capsules.h"
#include "observation/silhouette/planes.h"

namespace walktrack {
inline namespace observation {

// The area of the pixels that would be used; empty if the legs do not overlap. `parts`: those of
// the body with these capsules.
PixelRect leg_overlap(std::span<const Part> parts, const CapsuleList& now);

// The legs in one camera, in the previous or the present frame.
struct SeenLegs {
  const CapsuleList& capsules;
  const LogRatioPlanes& planes;
};

// Sum over pixels, nats times square pixels. `pair` contains the two frames around leg_overlap().
double leg_order_log_ratio(std::span<const Part> parts, const FramePair& pair,
                           const SeenLegs& before, const SeenLegs& now);

}  // namespace observation
}  // namespace walktrack
