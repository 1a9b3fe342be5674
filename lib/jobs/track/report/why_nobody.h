// The reason for which nobody was found in a video, in words: whether length, size in the picture,
// foreground or motion was missing, with the number. Frames of the video are read again for this.
#pragma once

#include <span>
#include <string>

#include "core/job_control.h"
#include "gait/prior/gait_prior.h"
#include "io/scene/scene.h"
#include "jobs/track/track_setup.h"
#include "tracker/detect/detector.h"

namespace walktrack {
inline namespace jobs {

struct SearchedVideo {
  const Scene& scene;
  DetectorConfig config;  // for what the scene shows
  const GaitPrior& prior;
  std::span<const Region> everywhere;  // by camera
  int threads;
};

// `seconds`: how long the video is. Begins with ": "; empty where a start was given, which is no
// matter of searching.
std::string why_nobody(const SearchedVideo& searched, TrackSetup& setup, double seconds,
                       const JobControl& control);

}  // namespace jobs
}  // namespace walktrack
