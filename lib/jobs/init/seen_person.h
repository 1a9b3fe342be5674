// The keypoints of the person who moves farthest in a video, detected by the program's pose
// network.
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

// InputError that names the video if it has no frame rate or nobody is detected; UsageError if the
// program was built without the network. At most a minute with a person in it is searched.
SeenPerson seen_person(const std::filesystem::path& video, const std::optional<double>& frame_rate,
                       const JobControl& control);

}  // namespace jobs
}  // namespace walktrack
