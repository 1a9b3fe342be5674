// Where a gait's feet lie flat on the ground.
#pragma once

#include <vector>

#include "body/flat_foot.h"
#include "body/motion.h"
#include "metrics/gait.h"

namespace walktrack {
inline namespace metrics {

// The rows of the motion in which soles lie flat (metrics/gait.h: kFlatFrom, kFlatTo). Of a stance
// that an end of the motion cuts, the rows in which they would if it lasted as long as the whole
// ones do on average; none where there is no whole one.
std::vector<FlatFoot> flat_feet(const Motion& motion, const Gait& gait);

}  // namespace metrics
}  // namespace walktrack
