// What a track depends on: a checkpoint of it is fit for another process only where all of it is
// the same.
#pragma once

#include "io/archive/checkpoint_file.h"
#include "jobs/track/track.h"

namespace walktrack {

// Program, scene with calibrations, configuration (threads change no result), and the films by
// their sizes and times of change, keypoint files and the pose network by their content.
Origin origin_of(const TrackJob& job);

}  // namespace walktrack
