// The legs' names of a track, judged by its whole video (tracker/smooth/leg_labels.h).
#pragma once

#include <filesystem>

#include "body/body.h"
#include "jobs/track/results/track_results.h"

namespace walktrack {
inline namespace jobs {

// Whether any frame says anything of the names.
bool says_names(const TrackedFrames& frames);

// The frames with the legs swapped where that is likelier than not, and with the probability that
// they are swapped all the same; in a file that leaves nothing behind.
TrackedFrames named(const TrackedFrames& frames, const Body& body,
                    const std::filesystem::path& file);

}  // namespace jobs
}  // namespace walktrack
