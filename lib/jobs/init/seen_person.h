// The keypoints, by the program's pose network, of the person who moves farthest in a video.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "core/job_control.h"
#include "observation/two_views/two_views.h"

namespace walktrack {
inline namespace jobs {

struct SeenPerson {
  int width_px = 0, height_px = 0;
  double frame_rate = 0;  // Hz
  std::vector<SeenMoment> moments;
  std::vector<int> frames;  // of the video, by moment
};

// InputError naming the video where it has no frame rate or nobody is seen; UsageError where the
// program was built without the network. At most a minute in which somebody is seen is looked at.
SeenPerson seen_person(const std::filesystem::path& video, const std::optional<double>& frame_rate,
                       const JobControl& control);

}  // namespace jobs
}  // namespace walktrack
