// The intervals in which the feet of a gait are flat on the ground.
#pragma once

#include <vector>

#include "body/flat_foot.h"
#include "body/motion.h"
#include "metrics/gait.h"

namespace walktrack {
inline namespace metrics {

// The rows of the motion in which soles are flat (metrics/gait.h: kFlatFrom, kFlatTo). For a stance
// that is cut by an end of the motion, they are computed with the mean duration of complete
// stances; there are none if no stance is complete.
std::vector<FlatFoot> flat_feet(const Motion& motion, const Gait& gait);

}  // namespace metrics
}  // namespace walktrack
