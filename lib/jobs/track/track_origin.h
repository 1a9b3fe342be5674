// What a track depends on: a checkpoint of it is fit for another process, and a result need not be
// made again, only where all of it is the same.
#pragma once

#include "io/archive/origin.h"
#include "io/config/config.h"
#include "io/scene/scene.h"

namespace walktrack {
inline namespace jobs {

// The scene's file, calibrations and videos, named from the scene's folder, with their digests
// (io/video/video_digest.h), and where keypoints are used their files and the pose network. The
// truth is none of them.
Origin input_digests(const Scene& scene, const KeypointConfig& keypoints);

// Program, inputs and configuration (threads change no result).
Origin origin_of(const ConfigWithOrigin& config, const Origin& inputs);

// What a track of the scene with this configuration would depend on, what the configuration leaves
// to the scene decided.
Origin origin_of_track(const Scene& scene, ConfigWithOrigin config);

// What the result that is in the folder was made of otherwise than is wanted now, in words; that
// of its checkpoint where it is not complete. "" = nothing, or there is neither.
std::string changes_since(const std::filesystem::path& folder, const Origin& wanted);

}  // namespace jobs
}  // namespace walktrack
