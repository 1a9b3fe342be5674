// Which leg is in front. Where the legs overlap in an image the nearer one is seen, and it moves as
// the nearer one moves: one swings, the other stands. Of a pixel u that both legs cover, says the
// pose, the nearer leg was at n one frame ago and the farther one at f. With the grey images I
// (now) and J (before),
//   log ratio = (dof + 1)/2 [ log(dof + (I(u) - J(f))^2 / s^2) - log(dof + (I(u) - J(n))^2 / s^2) ]
// is the evidence for the pose's order of the legs against the other one, s^2 the variance of a
// difference (frame_pair.h), squares over s^2 at most 9. Both orders have the same outline: where
// silhouettes from the side cannot tell left from right, this can.
//
// Only pixels well inside both legs are used, which are hidden by nothing else and lie below the
// swinging hands: an arm, which the body does not have, swings with the leg that is farther away
// and would be evidence for the wrong order. A pixel that looks like the empty scene, now or at the
// place from which it would come, shows no leg and gives no evidence, and neither does cloth
// without texture or shading.
#pragma once

#include <span>

#include "observation/flow/frame_pair.h"
#include "observation/silhouette/capsules.h"
#include "observation/silhouette/planes.h"

namespace walktrack {
inline namespace observation {

// The area of the pixels that would be used; empty while the legs do not overlap. `parts`: of the
// body whose capsules these are.
PixelRect leg_overlap(std::span<const Part> parts, const CapsuleList& now);

// Of one camera, in the frame before or now.
struct SeenLegs {
  const CapsuleList& capsules;
  const LogRatioPlanes& planes;
};

// Sum over pixels, nats times square pixels. `pair` holds the two frames around leg_overlap().
double leg_order_log_ratio(std::span<const Part> parts, const FramePair& pair,
                           const SeenLegs& before, const SeenLegs& now);

}  // namespace observation
}  // namespace walktrack
