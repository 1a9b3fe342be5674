// Keypoints of a rendered video as a pose detector would write them, with the errors that the
// options state: OpenPose JSON with the 26 points of HALPE_26, one file for each frame.
//
// A point's error is normal, with a standard deviation of noise x height of the person in the image
// / sqrt(confidence); confidences are spread evenly over 0.4 to 1. The face has only a nose (at the
// middle of the head); the feet have big toes and no heels. Occlusion is not modelled.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "observation/keypoints/keypoints.h"
#include "synth/recording/stage.h"

namespace walktrack {
inline namespace jobs {

// The people in one frame of a camera, in a random order.
DetectedPeople rendered_keypoints(const Stage& stage, const Camera& camera,
                                  const KeypointFaults& faults, uint64_t seed, uint32_t stream,
                                  uint32_t frame, double time);

std::string openpose_json(const DetectedPeople& people);

// The folder of a camera's keypoints, in the scene's folder.
std::string keypoint_folder(const std::string& camera);

// "<camera>_000000000012_keypoints.json"
inline constexpr const char* kOpenPoseEnding = "_keypoints.json";
std::string openpose_file_name(const std::string& camera, size_t frame);

}  // namespace jobs
}  // namespace walktrack
