// The decisions and checks that precede work on a scene's videos: terms that are `auto`, the
// scene's checks, and the lag between cameras.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/job_control.h"
#include "jobs/track/track.h"

namespace walktrack {
inline namespace jobs {

struct CheckedJob {
  TrackJob job;  // with the terms that are used, and with the lag
  std::vector<std::string> findings;
  std::optional<FoundLag> lag;
};

// Reports the findings. Throws InputError for the first failed check, with advice, unless failures
// are ignored, and UsageError if no term is on.
CheckedJob checked_job(const TrackJob& given, const JobControl& control);

}  // namespace jobs
}  // namespace walktrack
