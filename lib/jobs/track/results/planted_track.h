// A track whose feet stand still where its own gait says that they stand.
#pragma once

#include <filesystem>

#include "jobs/track/results/track_results.h"

namespace walktrack {
inline namespace jobs {

// The frames with their standing feet in place (tracker/smooth/planting.h). Their records lie in a
// file of that name, which the folder does not show any more.
TrackedFrames planted(const TrackedFrames& frames, const std::filesystem::path& file);

}  // namespace jobs
}  // namespace walktrack
