// The reason why no subject was found in a video, in words: whether length, size in the image,
// foreground or motion was insufficient, with the number. Frames of the video are read again for
// this.
#pragma once

#include <span>
#include <string>

#include "core/job_control.h"
#include "gait/prior/gait_prior.h"
#include "io/scene/scene.h"
#include "jobs/track/track_setup.h"
#include "tracker/detect/detector_config.h"

namespace walktrack {
inline namespace jobs {

struct SearchedVideo {
  const Scene& scene;
  DetectorConfig config;  // adapted to the scene
  const GaitPrior& prior;
  std::span<const Region> everywhere;  // by camera
  int threads;
};

// `seconds`: the duration of the video. The text begins with ": "; it is empty if a start was
// given, because then nothing is searched.
std::string why_nobody(const SearchedVideo& searched, TrackSetup& setup, double seconds,
                       const JobControl& control);

}  // namespace jobs
}  // namespace walktrack
