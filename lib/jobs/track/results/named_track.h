// The labels of the legs of a track, decided by its whole video (tracker/smooth/leg_labels.h).
#pragma once

#include <filesystem>

#include "body/body.h"
#include "jobs/track/results/track_results.h"

namespace walktrack {
inline namespace jobs {

// Whether any frame has evidence about the labels.
bool says_names(const TrackedFrames& frames);

// The frames with the legs swapped where that is likelier than not, and with the probability that
// they are swapped nevertheless; in a file that is deleted when it is closed.
TrackedFrames named(const TrackedFrames& frames, const Body& body,
                    const std::filesystem::path& file);

}  // namespace jobs
}  // namespace walktrack
