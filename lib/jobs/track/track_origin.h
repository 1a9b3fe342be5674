// What a track depends on: a checkpoint can be used by another process, and a result need not be
// computed again, only if all of it is the same.
#pragma once

#include "io/archive/origin.h"
#include "io/config/config.h"
#include "io/scene/scene.h"

namespace walktrack {
inline namespace jobs {

// The scene's file, calibrations and videos, with paths relative to the scene's folder and their
// digests (io/video/video_digest.h), and the keypoint files and the pose network if keypoints are
// used. The truth is not included.
Origin input_digests(const Scene& scene, const KeypointConfig& keypoints);

// Program, inputs and configuration (threads change no result).
Origin origin_of(const ConfigWithOrigin& config, const Origin& inputs);

// The origin of a track of the scene with this configuration, after everything that the
// configuration leaves to the scene has been decided.
Origin origin_of_track(const Scene& scene, ConfigWithOrigin config);

// How the result in the folder, or its checkpoint if the result is not complete, differs in its
// origin from the wanted one, in words; "" if it does not, or if there is neither.
std::string changes_since(const std::filesystem::path& folder, const Origin& wanted);

}  // namespace jobs
}  // namespace walktrack
