// Optical flow without measuring it: the probability of a frame given the previous frame if a body
// has moved from one pose to the other.
//
// With the grey images I (now) and J (before), and the visible silhouette S, every pixel u of the
// frame belongs to one of three kinds:
//   of the body, u in S_now: the same material point was at w in the previous frame. I(u) is
//     Student-t about J(w), or uniform, 1 / 256, if another part hid the point or w is outside the
//     image;
//   uncovered, u in S_before and not in S_now: background that J does not show; I(u) follows the
//     background's model, or is uniform without one;
//   background at rest: I(u) is Student-t about J(u).
// For any two poses this is a normalised density of all pixels that are used, and the term is
//   sum over S_now [log p_body - log p_rest] + sum over S_before \ S_now [log p_uncovered - log
//   p_rest],
// which is zero for a body at rest. The squared scale of the Student-t is noise^2 + (error_px^2 +
// error_share^2 |u - w|^2) |grad J|^2, both for a body at rest and for background. J has been
// scaled to the brightness of I.
//
// Moving things that are not part of the body (arms that it does not have, shadows, people behind)
// must not attract the body: a tenth of the pixels, at rest or of the body, may have any colour,
// which bounds the effect of a single pixel.
//
// The pixels that are used form a lattice with a spacing of a few centimetres on the body, after
// smoothing that matches this spacing, and each represents its area. Measured flow would be wrong
// in exactly the places that matter (reports/flow.md), and it is not needed, because each particle
// has its own motion.
#pragma once

#include "observation/flow/flow_field.h"
#include "observation/observation_config.h"
#include "observation/silhouette/capsules.h"

namespace walktrack {
inline namespace observation {

// In nats times square pixels: each cell is weighted by its area. `now` and `before` are the
// capsules of one particle in this and the previous frame.
double flow_log_ratio(const FlowConfig& config, const FlowField& flow, const CapsuleList& now,
                      const CapsuleList& before);

}  // namespace observation
}  // namespace walktrack
