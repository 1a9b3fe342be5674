// A track whose feet stand still where its own gait says that they stand.
#pragma once

#include <filesystem>
#include <vector>

#include "jobs/track/results/track_results.h"
#include "metrics/gait.h"
#include "tracker/smooth/planting.h"

namespace walktrack {
inline namespace jobs {

// The rows of the motion in which soles lie flat (metrics/gait.h: kFlatFrom, kFlatTo). Of a stance
// that an end of the motion cuts, the rows in which they would if it lasted as long as the whole
// ones do on average; none where there is no whole one.
std::vector<FlatFoot> flat_feet(const Motion& motion, const Gait& gait);

// The frames with their standing feet in place (tracker/smooth/planting.h). Their records lie in a
// file of that name, which the folder does not show any more.
TrackedFrames planted(const TrackedFrames& frames, const std::filesystem::path& file);

}  // namespace jobs
}  // namespace walktrack
